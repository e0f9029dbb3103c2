#include "harness/model/assemble.h"

#include <algorithm>
#include <stdexcept>
#include <cmath>
#include <filesystem>
#include <string>
#include <system_error>
#include <string_view>
#include <vector>

#include "dem/assembly/contacts.h"
#include "dem/core/narrow.h"
#include "harness/io/errors.h"
#include "harness/model/file_packing.h"
#include "harness/model/memory_need.h"
#include "harness/model/random_packing.h"
#include "harness/scene/place.h"
#include "meshes/packings/hexagonal.h"
#include "meshes/packings/porosity.h"

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
  } catch (const packings::PorosityOutOfReach& e) {
    throw InputError(scene_problem(scene, "assembly.porosity", e.what(), ""));
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
                        spec.columns = narrow<int>(l.columns, "assembly.columns");
                        spec.rows = narrow<int>(l.rows, "assembly.rows");
                        spec.radius = l.radius;
                      },
                      [&](const HexagonalRectangle& r) {
                        spec.length = r.length;
                        spec.width = r.width;
                        spec.discs = narrow<int>(r.discs, "assembly.discs");
                      }},
             p.size);
  return packings::hexagonal(spec);
}

Packing packing_with(const Scene& scene, Periodicity periodic) {
  require_memory_of_discs(scene, DiscWork::packing);
  return naming_scene(scene, "assembly.packing", [&] {
    return std::visit(Overload{[&](const RandomPacking& p) { return random_packing(p, periodic); },
                               [&](const HexagonalPacking& p) { return hexagonal_packing(p, periodic); },
                               [&](const FilePacking& p) { return file_packing(scene, p); }},
                      scene.assembly.packing);
  });
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
                  : file_bonds(packing, std::get<BondFile>(scene.assembly.bonding));
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

/// A lattice closes on an even number of rows only, and on so many that no pair of discs touches through two images, however
/// large the gap (8 r; rows lie sqrt(3) r apart, or 2 r): more rows are the same material.
HexagonalLattice closing_lattice(const Scene& scene, const HexagonalPacking& hexagonal) {
  const bool along_x = hexagonal.close_packed_along == Axis::x;
  HexagonalLattice lattice;
  if (const auto* given = std::get_if<HexagonalLattice>(&hexagonal.size)) {
    lattice = *given;
  } else {
    const Packing free = build_packing(scene);
    lattice.radius = free.radius.front();
    lattice.rows = std::lround(free.width / ((along_x ? std::sqrt(3.0) : 2.0) * lattice.radius));
    lattice.columns = static_cast<std::int64_t>(free.size()) / lattice.rows;
  }
  lattice.rows = along_x ? std::max<std::int64_t>(6, lattice.rows + lattice.rows % 2) : std::max<std::int64_t>(5, lattice.rows);
  return lattice;
}

bool reaches_through_y(const ddem::Assembly& a) {
  return cut_at_edges(a.packing, a.bonds, false, true).size() < a.bonds.size();
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

LaterallyClosed build_laterally_closed(const Scene& scene) {
  if (scene.assembly.periodic.y) return {build_assembly(scene), ""};
  Scene closed = scene;
  closed.assembly.periodic.y = true;
  if (const auto* file = std::get_if<FilePacking>(&scene.assembly.packing)) {
    if (!file->width) return {std::nullopt, "a packing from a file does not close in y without its width as the period: give assembly.width"};
    if (std::holds_alternative<BondFile>(scene.assembly.bonding)) return {std::nullopt, "listed bonds do not close in y: let bond_gap make them"};
  }
  if (auto* hexagonal = std::get_if<HexagonalPacking>(&closed.assembly.packing)) hexagonal->size = closing_lattice(scene, *hexagonal);
  try {
    LaterallyClosed out{build_assembly(closed), ""};
    if (reaches_through_y(*out.assembly)) return out;
    return {std::nullopt, "no bond reaches through the period in y, the width: give the width at which the packing repeats"};
  } catch (const InputError& e) {
    return {std::nullopt, e.what()};
  }
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
