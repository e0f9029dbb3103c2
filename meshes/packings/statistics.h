#pragma once
// What a packing is like, from its centres and radii alone.

#include "dem/core/packing.h"
#include "meshes/packings/flat_walls.h"

namespace ddem::packings {

struct PackingStatistics {
  double porosity = 0.0;         ///< 1 - area of the discs / (length width)
  double mean_radius = 0.0;      ///< m
  double largest_overlap = 0.0;  ///< of two discs, or of a disc and a wall, in mean radii
  double unbalanced_force = 0.0; ///< largest net force on a disc over the mean contact force; forces are overlaps
  int contacts = 0;              ///< pairs that overlap, and discs that overlap a wall
  int rattlers = 0;              ///< discs that no contacts hold: fewer than three, peeled
  /// Contacts of a disc on average, without rattlers and theirs. Rigid frictionless discs in balance have 4, and as many as they need
  /// and no more at the jamming point (O'Hern, Silbert, Liu and Nagel, Phys. Rev. E 68, 011306, 2003). 0 where nothing is held.
  double held_coordination = 0.0;
  /// Difference of the eigenvalues of the fabric tensor <n n> of all contacts between discs (Satake, 1978): 0 where contacts have no
  /// preferred direction, 1 where all are parallel. n directions at random have the root mean square 1/sqrt(n).
  double fabric_anisotropy = 0.0;
  /// Fraction of discs in hexagonal surroundings: six neighbours (gaps up to 0.5 mean radii) and |psi_6| > 0.9, where
  /// psi_6 = <exp(6 i angle)> over the neighbours (Nelson and Halperin, Phys. Rev. B 19, 2457, 1979). Rattlers and the
  /// discs at free edges count as disordered. 1 in a lattice.
  double ordered_fraction = 0.0;
};

/// Throws std::invalid_argument on what close_pairs() refuses.
PackingStatistics statistics_of(const Packing& packing, FlatWalls walls = {});

/// More of it than this, and the packing is called a crystal: it has the elasticity of a polycrystal, not of a random
/// assembly. 682 discs, measured: 0.05 to 0.13 at radius ratio 1.67, 0.01 at 10, 0.46 to 0.78 at 1.
inline constexpr double kCrystalFraction = 0.3;

}  // namespace ddem::packings
