#include "harness/model/assemble.h"

#include <algorithm>
#include <stdexcept>
#include <cmath>
#include <future>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <tuple>

#include "dem/assembly/contacts.h"
#include "dem/assembly/packing_check.h"
#include "harness/io/errors.h"
#include "harness/scene/csv.h"
#include "harness/scene/place.h"
#include "meshes/packings/hexagonal.h"
#include "meshes/packings/random.h"

namespace ddem::harness {
namespace {

template <class... F>
struct Overload : F... {
  using F::operator()...;
};
template <class... F>
Overload(F...) -> Overload<F...>;

/// The key of [assembly] that a user would change first.
std::string_view bonding_key(const Scene& scene) {
  for (const std::string_view key : {"assembly.bonds", "assembly.coordination", "assembly.bond_gap"}) {
    if (scene.places.contains(std::string(key))) return key;
  }
  return "assembly.packing";
}

/// Library errors know no scene, and end with their remedy after a semicolon: this adds the place.
template <class F>
auto naming_scene(const Scene& scene, std::string_view key, F&& f) {
  try {
    return f();
  } catch (const std::invalid_argument& e) {
    throw InputError(scene_problem(scene, key, e.what(), ""));
  }
}

/// Jamming takes a thousand times as long as a wave run of the packing, and a campaign runs many waves in one packing:
/// each is made once in a process. Threads that ask for the same packing wait for the one that makes it.
Packing random_packing(const RandomPacking& p) {
  using Key = std::tuple<double, double, std::int64_t, std::int64_t, double>;
  static std::mutex mutex;
  static std::map<Key, std::shared_future<Packing>> made;
  std::promise<Packing> promise;
  std::shared_future<Packing> packing;
  bool make = false;
  {
    const std::lock_guard lock(mutex);
    auto [entry, absent] = made.try_emplace(Key{p.length, p.width, p.discs, p.seed, p.radius_ratio});
    make = absent;
    if (absent) entry->second = promise.get_future().share();
    packing = entry->second;
  }
  if (make) {
    try {
      promise.set_value(packings::random_jammed({.length = p.length,
                                                 .width = p.width,
                                                 .discs = static_cast<int>(p.discs),
                                                 .seed = static_cast<std::uint64_t>(p.seed),
                                                 .radius_ratio = p.radius_ratio}));
    } catch (...) {
      promise.set_exception(std::current_exception());
    }
  }
  return packing.get();
}

Packing hexagonal_packing(const HexagonalPacking& p, Periodicity periodic) {
  packings::HexagonalSpec spec;
  spec.close_packed = p.close_packed_along == Axis::x ? packings::CloseRows::along_x : packings::CloseRows::along_y;
  spec.periodic_x = periodic.x;
  spec.periodic_y = periodic.y;
  std::visit(Overload{[&](const HexagonalLattice& l) {
                        spec.columns = static_cast<int>(l.columns);
                        spec.rows = static_cast<int>(l.rows);
                        spec.radius = l.radius;
                      },
                      [&](const HexagonalRectangle& r) {
                        spec.length = r.length;
                        spec.width = r.width;
                        spec.discs = static_cast<int>(r.discs);
                      }},
             p.size);
  return packings::hexagonal(spec);
}

Packing unchecked_file_packing(const Scene& scene, const FilePacking& p) {
  const auto table = read_disc_table(p.discs);
  if (!table) {
    std::vector<std::string> lines;
    for (const Violation& v : table.violations) lines.push_back(to_string(v));
    throw InputError(lines);
  }
  Packing packing{table->x, table->y, table->radius, {}, 0.0, 0.0};
  if (packing.size() < 2) throw InputError(scene_problem(scene, "assembly.file", "fewer than two discs", "give at least two rows"));
  const auto extent = [&](const std::vector<double>& c) {
    double lo = c[0], hi = c[0];
    for (std::size_t d = 0; d < c.size(); ++d) {
      lo = std::min(lo, c[d] - packing.radius[d]);
      hi = std::max(hi, c[d] + packing.radius[d]);
    }
    return hi - lo;
  };
  packing.length = p.length.value_or(extent(packing.x));
  packing.width = p.width.value_or(extent(packing.y));
  packing.period = {scene.assembly.periodic.x ? packing.length : 0.0, scene.assembly.periodic.y ? packing.width : 0.0};
  return packing;
}

Packing file_packing(const Scene& scene, const FilePacking& p) {
  Packing packing = unchecked_file_packing(scene, p);
  const auto problems = packing_problems(packing);
  if (!problems.empty()) {
    std::vector<std::string> lines;
    for (const std::string& problem : problems) lines.push_back(p.discs.string() + ": " + problem);
    lines.push_back("  (discs count from 0 in the order of the rows; move them apart, shrink them, or correct the periods)");
    throw InputError(lines);
  }
  return packing;
}

Packing packing_with(const Scene& scene, Periodicity periodic) {
  return naming_scene(scene, "assembly.packing", [&] {
    return std::visit(Overload{[](const RandomPacking& p) { return random_packing(p); },
                               [&](const HexagonalPacking& p) { return hexagonal_packing(p, periodic); },
                               [&](const FilePacking& p) { return file_packing(scene, p); }},
                      scene.assembly.packing);
  });
}

Bonds bonds_for(const Scene& scene, const Packing& packing) {
  return std::visit(
      Overload{[&](const BondGap& g) { return bonds_within_gap(packing, g.mean_radii * mean_radius(packing)); },
               [&](const BondCoordination& c) {
                 return bonds_within_gap(packing, gap_for_coordination(packing, c.bonds_per_disc));
               },
               [&](const BondFile& f) {
                 const auto table = read_bond_table(f.path);
                 if (!table) {
                   std::vector<std::string> lines;
                   for (const Violation& v : table.violations) lines.push_back(to_string(v));
                   throw InputError(lines);
                 }
                 return bonds_between(packing, *table);
               }},
      scene.assembly.bonding);
}

ddem::Assembly assembly_with(const Scene& scene, Periodicity periodic) {
  Packing packing = packing_with(scene, periodic);
  return naming_scene(scene, bonding_key(scene), [&] {
    const Bonds bonds = cut_at_edges(packing, bonds_for(scene, packing), !periodic.x, !periodic.y);
    if (!periodic.x) packing.period.x = 0.0;
    if (!periodic.y) packing.period.y = 0.0;
    const bool by_chance = std::holds_alternative<RandomPacking>(scene.assembly.packing);
    return make_assembly(packing, bonds, scene.assembly.thickness, scene.material.value().density,
                         by_chance ? RattlerRule::peel : RattlerRule::none);
  });
}

}  // namespace

Packing build_packing(const Scene& scene) { return packing_with(scene, scene.assembly.periodic); }

ddem::Assembly build_assembly(const Scene& scene) { return assembly_with(scene, scene.assembly.periodic); }

std::optional<ddem::Assembly> build_laterally_closed(const Scene& scene) {
  if (scene.assembly.periodic.y) return build_assembly(scene);
  Scene closed = scene;
  closed.assembly.periodic.y = true;
  if (const auto* file = std::get_if<FilePacking>(&scene.assembly.packing)) {
    const bool own_bonds = std::holds_alternative<BondFile>(scene.assembly.bonding);
    if (!file->width || own_bonds || !packing_problems(unchecked_file_packing(closed, *file)).empty()) return std::nullopt;
  }
  // A lattice closes on an even number of rows only: one more row is the same material.
  if (auto* hexagonal = std::get_if<HexagonalPacking>(&closed.assembly.packing)) {
    if (auto* lattice = std::get_if<HexagonalLattice>(&hexagonal->size)) {
      if (hexagonal->close_packed_along == Axis::x) lattice->rows += lattice->rows % 2;
    } else {
      const Packing free = build_packing(scene);
      const double r = free.radius.front();
      const auto rows = std::lround(free.width / (hexagonal->close_packed_along == Axis::x ? std::sqrt(3.0) * r : 2.0 * r));
      const auto columns = static_cast<long>(free.size()) / rows;
      hexagonal->size = HexagonalLattice{columns, hexagonal->close_packed_along == Axis::x ? rows + rows % 2 : rows, r};
    }
  }
  return build_assembly(closed);
}

ContactParameters contact_parameters(const Scene& scene) {
  const Contact& c = scene.contact.value();
  ContactParameters p;
  p.stiffness_ratio = c.stiffness_ratio;
  p.kinematics = c.kinematics == Kinematics::linear ? ddem::Kinematics::linear : ddem::Kinematics::nonlinear;
  if (const auto* modulus = std::get_if<ContactModulus>(&c.stiffness)) {
    p.contact_modulus = modulus->pascal;
  } else {
    p.normal_stiffness = std::get<NormalStiffness>(c.stiffness).k_n;
  }
  return p;
}

DeformationParameters deformation_parameters(const Scene& scene) {
  if (!scene.deformation) return {};
  const Deformation& d = *scene.deformation;
  DeformationParameters p;
  p.scheme = d.scheme == DeformationScheme::implicit ? Scheme::implicit : Scheme::lagged;
  p.evaluations = static_cast<int>(d.evaluations);
  p.relaxation = d.relaxation;
  p.tolerance = d.tolerance;
  p.solver = d.solver == StrainSolver::polynomial ? ddem::StrainSolver::polynomial : ddem::StrainSolver::conjugate_gradients;
  p.volume = d.volume == ParticleVolume::disc ? ddem::ParticleVolume::disc : ddem::ParticleVolume::cell;
  p.correction = d.correction == Correction::normal ? ddem::Correction::normal
                 : d.correction == Correction::full ? ddem::Correction::full
                                                    : ddem::Correction::normal_only_stress;
  p.young_modulus = d.young_modulus;
  p.poisson_ratio = d.poisson_ratio;
  p.plane = d.plane == Plane::stress ? ddem::Plane::stress : ddem::Plane::strain;
  return p;
}

double edge_band(const Scene& scene, const ddem::Assembly& assembly) {
  return scene.assembly.edge_band * mean_radius(assembly.packing);
}

}  // namespace ddem::harness
