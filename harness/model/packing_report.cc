#include "harness/model/packing_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <variant>

#include "dem/assembly/assembly.h"
#include "dem/assembly/contacts.h"
#include "dem/assembly/rattlers.h"
#include "harness/model/assemble.h"
#include "harness/model/random_packing.h"
#include "harness/scene/units.h"

namespace ddem::harness {
namespace {

std::optional<std::string> crystal_text(const packings::PackingStatistics& s) {
  if (s.ordered_fraction <= packings::kCrystalFraction) return std::nullopt;
  return fmt::format("{:.0f} % of the discs lie in hexagonal order: discs of nearly the same size crystallise; this packing is "
                     "a polycrystal, not a random one (radius_ratio = 1.3 or more avoids it)",
                     100.0 * s.ordered_fraction);
}

}  // namespace

PackingReport report_on_packing(const Scene& scene, const Packing& packing) {
  const Periodicity periodic = scene.assembly.periodic;
  PackingReport r;
  r.discs = packing.size();
  r.length = packing.length;
  r.width = packing.width;
  const auto [smallest, largest] = std::ranges::minmax(packing.radius);
  r.smallest_radius = smallest, r.largest_radius = largest;
  r.tiling = {1, 1, static_cast<int>(packing.size())};
  packings::FlatWalls walls;
  const auto* random = std::get_if<RandomPacking>(&scene.assembly.packing);
  if (random != nullptr) {
    r.jammed = true;
    walls = walls_of(*random, periodic);
    r.tiling = tiling_of(*random, periodic);
  }
  r.statistics = packings::statistics_of(packing, walls);

  const Bonding bonding = bonding_of(scene, packing);
  r.coordination = bonding.coordination;
  if (bonding.gap) r.bond_gap = *bonding.gap / r.statistics.mean_radius;
  const Bonds bonds = cut_at_edges(packing, bonding.bonds, !periodic.x, !periodic.y);
  std::vector<char> loose(packing.size(), 0);
  if (random != nullptr)
    for (const int d : find_rattlers(packing.size(), bonds)) loose[d] = 1;
  for (const char mark : loose) r.rattlers += mark != 0 ? 1 : 0;
  for (std::size_t b = 0; b < bonds.size(); ++b) r.bonds += !loose[bonds.i[b]] && !loose[bonds.j[b]] ? 1 : 0;
  if (r.rattlers < r.discs)
    r.network_coordination = 2.0 * static_cast<double>(r.bonds) / static_cast<double>(r.discs - r.rattlers);

  if (random != nullptr) {
    if (const auto warning = crystal_text(r.statistics)) r.warnings.push_back(*warning);
  }
  return r;
}

std::optional<std::string> crystal_warning(const Scene& scene) {
  const auto* random = std::get_if<RandomPacking>(&scene.assembly.packing);
  if (random == nullptr) return std::nullopt;
  const Periodicity periodic = scene.assembly.periodic;
  return crystal_text(packings::statistics_of(jammed_cell(*random, periodic), walls_of(*random, periodic)));
}

Json packing_json(const PackingReport& r) {
  const packings::PackingStatistics& s = r.statistics;
  Json j{{"discs", r.discs}, {"length", r.length}, {"width", r.width}};
  j["porosity"] = s.porosity;
  j["mean_radius"] = s.mean_radius;
  j["smallest_radius"] = r.smallest_radius;
  j["largest_radius"] = r.largest_radius;
  j["largest_overlap"] = s.largest_overlap;
  j["unbalanced_force"] = s.unbalanced_force;
  j["touching_pairs"] = s.contacts;
  j["unsupported_discs"] = s.rattlers;
  j["held_coordination"] = s.held_coordination;
  j["fabric_anisotropy"] = s.fabric_anisotropy;
  j["ordered_fraction"] = s.ordered_fraction;
  j["tiles"] = {r.tiling.nx, r.tiling.ny};
  j["discs_in_a_tile"] = r.tiling.discs;
  j["coordination"] = r.coordination;
  j["bond_gap"] = r.bond_gap ? Json(*r.bond_gap) : Json{{"status", "a file names the bonds"}};
  j["bonds"] = r.bonds;
  j["rattlers"] = r.rattlers;
  j["network_coordination"] = r.network_coordination;
  j["warnings"] = r.warnings;
  return j;
}

std::string packing_text(const PackingReport& r) {
  const packings::PackingStatistics& s = r.statistics;
  std::string text = fmt::format("{} discs in {} x {}, porosity {:.4f}, mean radius {} ({} to {})\n", r.discs, format_quantity(r.length, "m"),
                                 format_quantity(r.width, "m"), s.porosity, format_quantity(s.mean_radius, "m"),
                                 format_quantity(r.smallest_radius, "m"), format_quantity(r.largest_radius, "m"));
  if (r.tiling.nx * r.tiling.ny > 1)
    text += fmt::format("{} x {} copies of one periodic cell of {} discs\n", r.tiling.nx, r.tiling.ny, r.tiling.discs);
  text += fmt::format("largest overlap {:.2g} mean radii, {:.1f} % of the discs in hexagonal order\n", s.largest_overlap,
                      100.0 * s.ordered_fraction);
  if (r.jammed && s.contacts > 0)
    text += fmt::format("{} contacts hold {} discs, {:.3f} each (isostatic: 4), {} rattle; anisotropy of the fabric {:.3f} (by chance {:.3f})\n",
                        s.contacts, static_cast<std::int64_t>(r.discs) - s.rattlers, s.held_coordination, s.rattlers, s.fabric_anisotropy, 1.0 / std::sqrt(s.contacts));
  const std::string gap = r.bond_gap ? fmt::format(" (gaps up to {:.4f} mean radii)", *r.bond_gap) : "";
  text += fmt::format("coordination {:.3f}{}; as cut: {} bonds, {} rattlers, coordination {:.3f} without them\n", r.coordination,
                      gap, r.bonds, r.rattlers, r.network_coordination);
  for (const std::string& warning : r.warnings) text += fmt::format("warning: {}\n", warning);
  return text;
}

}  // namespace ddem::harness
