#pragma once
// What the packing and the bonds of a scene are like: for ddem pack, and for reports.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "harness/io/json.h"
#include "harness/scene/scene.h"
#include "meshes/packings/statistics.h"
#include "meshes/packings/tiling.h"

namespace ddem::harness {

struct PackingReport {
  std::size_t discs = 0;
  double length = 0.0, width = 0.0;  ///< m
  double smallest_radius = 0.0, largest_radius = 0.0;  ///< m
  bool jammed = false;  ///< a random packing, whose contacts hold each other
  packings::PackingStatistics statistics;
  packings::Tiling tiling;  ///< 1 x 1 for what is jammed as a whole, and for lattices and files

  /// Bonds of a disc on average, before edges are cut, rattlers included: what assembly.coordination asks for. Between
  /// flat walls, of the discs more than a mean radius away from them.
  double coordination = 0.0;
  std::optional<double> bond_gap;  ///< in mean radii; none where a file names the bonds
  std::size_t bonds = 0;           ///< that carry force: without those cut at free edges and those of rattlers
  std::size_t rattlers = 0;        ///< discs on fewer than two bonds, repeatedly
  double network_coordination = 0.0;  ///< 2 bonds over the discs that are no rattlers: of the very strip
  std::vector<std::string> warnings;  ///< a random packing that crystallised
};

/// `packing` is build_packing(scene). Throws InputError where the bonds cannot be made.
PackingReport report_on_packing(const Scene& scene, const Packing& packing);

/// What `ddem run` says of a random packing that crystallised; nothing of others. Of a tiled one the cell is looked at.
std::optional<std::string> crystal_warning(const Scene& scene);

Json packing_json(const PackingReport& report);
/// Lines of text for people, each ended by a newline.
std::string packing_text(const PackingReport& report);

}  // namespace ddem::harness
