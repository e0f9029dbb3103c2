#pragma once
// Packings and bonds that a scene takes from files, and whether they are what the scene says.

#include "dem/core/bonds.h"
#include "dem/core/packing.h"
#include "harness/scene/scene.h"

namespace ddem::harness {

/// With the scene's length and width, or those of outline.h where it gives none. Throws InputError where the file cannot be
/// read, where discs overlap (packing_check.h), and where they contradict the size: in a direction that is not periodic the
/// centres span more than it; it reaches beyond the discs by more than two of the largest diameters, so that nothing fills it
/// and no bond passes it; the discs fill more than all of it.
Packing file_packing(const Scene& scene, const FilePacking& p);

/// Bonds over gaps beyond this many mean radii are taken for slips, as bond_gap ends there.
inline constexpr double kLongestListedGap = 2.0;

/// Throws InputError naming file and line of what cannot be a bond: a disc that does not exist, a pair given twice, discs too
/// far apart.
Bonds file_bonds(const Packing& packing, const BondFile& file);

}  // namespace ddem::harness
