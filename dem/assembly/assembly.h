#pragma once
// An assembly: discs with mass, and the bonds between them that carry force.

#include <cstdint>
#include <vector>

#include "dem/core/bonds.h"
#include "dem/core/packing.h"

namespace ddem {

struct Assembly {
  Packing packing;
  Bonds bonds;             ///< without the bonds of rattlers
  double thickness = 1.0;  ///< m, out of plane
  double density = 0.0;    ///< of a disc, kg/m3
  std::vector<double> mass, inertia, volume;  ///< kg, kg m2, m3: m = rho pi r^2 h, I = m r^2 / 2
  /// Ascending. They weigh but carry no bond: see RattlerRule and network_discs().
  std::vector<int> rattlers;

  std::size_t size() const { return packing.size(); }
  double area() const { return packing.length * packing.width; }
};

enum class RattlerRule {
  peel,  ///< discs on fewer than two bonds are rattlers, repeatedly: for packings made by chance
  none,  ///< every disc belongs to the network: for packings that somebody laid out, chains included
  apart  ///< discs without a bond are rattlers, and there may be several networks, which new contacts may join
};

/// Takes the bonds of rattlers out and computes masses.
/// Throws std::invalid_argument if what is left is not one connected network, unless the rule is `apart`.
Assembly make_assembly(Packing packing, Bonds bonds, double thickness, double density,
                       RattlerRule rule = RattlerRule::none);

/// Throws std::invalid_argument unless all discs but the rattlers hang together: where statics needs it.
void require_one_network(const Assembly& assembly);

/// The same packing cut free: the bonds that reach through the period in x (and y) are left out.
/// Used for strips made from a periodic packing.
Bonds cut_at_edges(const Packing& packing, const Bonds& bonds, bool cut_x, bool cut_y);

/// The discs that are no rattlers, ascending. The rule: nothing holds a rattler, so no load strains it and no wave moves it.
/// Statics and waves see the assembly as if its rattlers were taken out and left voids behind: stiffness, strains, grips and
/// driven edges, probes, the mass that moves, the cells of discs. Rattlers count in what describes the sample: its discs,
/// coordination, mean radius (the unit of gaps and bands), solid fraction, bulk density.
std::vector<int> network_discs(const Assembly& assembly);
/// Centres of its first and last disc along x, m; of all discs where there is no network.
struct Ends {
  double left = 0.0, right = 0.0;
};
Ends network_ends(const Assembly& assembly);
/// Mass of the network over length * width * thickness, kg/m3: what a wave has to move.
double moving_density(const Assembly& assembly);

/// Area of all discs over length * width.
double solid_fraction(const Assembly& assembly);
/// Mass of all discs over length * width * thickness, kg/m3.
double bulk_density(const Assembly& assembly);

enum class Edge { left, right, bottom, top };
/// Discs whose centre lies within `band` (m) of the outermost centre at that edge, in ascending order.
std::vector<int> edge_discs(const Packing& packing, Edge edge, double band);
/// The same of the network alone: those that grips hold and drives move.
std::vector<int> edge_discs(const Assembly& assembly, Edge edge, double band);

}  // namespace ddem
