#include "harness/model/assemble.h"

#include <algorithm>
#include <stdexcept>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "dem/assembly/contacts.h"
#include "dem/assembly/packing_check.h"
#include "harness/io/errors.h"
#include "harness/model/random_packing.h"
#include "harness/scene/csv.h"
#include "harness/scene/place.h"
#include "meshes/packings/hexagonal.h"

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
    return std::visit(Overload{[&](const RandomPacking& p) { return random_packing(p, periodic); },
                               [&](const HexagonalPacking& p) { return hexagonal_packing(p, periodic); },
                               [&](const FilePacking& p) { return file_packing(scene, p); }},
                      scene.assembly.packing);
  });
}

Bonds bonds_of_file(const Packing& packing, const BondFile& file) {
  const auto table = read_bond_table(file.path);
  if (!table) {
    std::vector<std::string> lines;
    for (const Violation& v : table.violations) lines.push_back(to_string(v));
    throw InputError(lines);
  }
  return bonds_between(packing, *table);
}

/// Discs at flat walls have neighbours on one side only: they do not count.
std::vector<char> counted_discs(const Scene& scene, const Packing& packing, Periodicity periodic) {
  const auto* random = std::get_if<RandomPacking>(&scene.assembly.packing);
  return packings::inner_discs(packing, random != nullptr ? walls_of(*random, periodic) : packings::FlatWalls{});
}

/// Throws where discs that touch would have to stay without a bond.
double gap_for(const Scene& scene, const Packing& packing, Periodicity periodic, double coordination) {
  const auto* random = std::get_if<RandomPacking>(&scene.assembly.packing);
  // Of a tiled packing the gap of its cell: in the whole, every gap is there as often as there are tiles.
  const bool tiled = random != nullptr && tiling_of(*random, periodic).discs < random->discs;
  const Packing& of = tiled ? jammed_cell(*random, periodic) : packing;
  const std::vector<char> counted = counted_discs(scene, of, periodic);
  const double gap = gap_for_coordination(of, coordination, counted);
  if (random != nullptr && gap < 0.0)
    throw std::invalid_argument("the discs that touch make for a coordination of " +
                                std::to_string(ddem::coordination(bonds_within_gap(of, 0.0), counted)) +
                                " already; ask for more, or take a larger radius_ratio (equal discs crystallise)");
  return gap;
}

Bonding bonding_with(const Scene& scene, const Packing& packing, Periodicity periodic) {
  Bonding b;
  if (const auto* g = std::get_if<BondGap>(&scene.assembly.bonding)) b.gap = g->mean_radii * mean_radius(packing);
  if (const auto* c = std::get_if<BondCoordination>(&scene.assembly.bonding))
    b.gap = gap_for(scene, packing, periodic, c->bonds_per_disc);
  b.bonds = b.gap ? bonds_within_gap(packing, *b.gap)
                  : bonds_of_file(packing, std::get<BondFile>(scene.assembly.bonding));
  b.coordination = coordination(b.bonds, counted_discs(scene, packing, periodic));
  return b;
}

/// Bonds that somebody lists may leave discs and pieces apart, if these can touch.
RattlerRule rattler_rule(const Scene& scene) {
  if (std::holds_alternative<RandomPacking>(scene.assembly.packing)) return RattlerRule::peel;
  const bool listed = std::holds_alternative<BondFile>(scene.assembly.bonding);
  const bool may_touch = scene.contact && scene.contact->new_contacts == NewContacts::automatic;
  return listed && may_touch ? RattlerRule::apart : RattlerRule::none;
}

ddem::Assembly assembly_with(const Scene& scene, Periodicity periodic) {
  Packing packing = packing_with(scene, periodic);
  return naming_scene(scene, bonding_key(scene), [&] {
    const Bonds bonds = cut_at_edges(packing, bonding_with(scene, packing, periodic).bonds, !periodic.x, !periodic.y);
    if (!periodic.x) packing.period.x = 0.0;
    if (!periodic.y) packing.period.y = 0.0;
    return make_assembly(packing, bonds, scene.assembly.thickness, scene.material.value().density, rattler_rule(scene));
  });
}

}  // namespace

Packing build_packing(const Scene& scene) { return packing_with(scene, scene.assembly.periodic); }

Bonding bonding_of(const Scene& scene, const Packing& packing) {
  return naming_scene(scene, bonding_key(scene), [&] { return bonding_with(scene, packing, scene.assembly.periodic); });
}

ddem::Assembly build_assembly(const Scene& scene) { return assembly_with(scene, scene.assembly.periodic); }

ddem::Assembly build_network(const Scene& scene) {
  ddem::Assembly a = build_assembly(scene);
  return naming_scene(scene, bonding_key(scene), [&] {
    require_one_network(a);
    return std::move(a);
  });
}

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
  p.kinematics = c.kinematics;
  if (const auto* modulus = std::get_if<ContactModulus>(&c.stiffness)) {
    p.contact_modulus = modulus->pascal;
  } else {
    p.normal_stiffness = std::get<NormalStiffness>(c.stiffness).k_n;
  }
  return p;
}

DeformationParameters deformation_parameters(const Scene& scene) { return scene.deformation.value_or(DeformationParameters{}); }

double edge_band(const Scene& scene, const ddem::Assembly& assembly) {
  return scene.assembly.edge_band * mean_radius(assembly.packing);
}

}  // namespace ddem::harness
