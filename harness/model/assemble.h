#pragma once
// From a scene to the discs and bonds that it describes.

#include <optional>
#include <string>

#include "dem/assembly/assembly.h"
#include "dem/core/material.h"
#include "harness/scene/scene.h"

namespace ddem::harness {

/// The packing of the scene; a random one is periodic in x and y whatever the scene's edges are, but for directions with
/// flat walls. Throws InputError naming the scene's key.
Packing build_packing(const Scene& scene);

/// Bonds before edges are cut and rattlers leave.
struct Bonding {
  Bonds bonds;
  std::optional<double> gap;  ///< m; none where a file names the bonds
  double coordination = 0.0;  ///< of all discs, rattlers included; between flat walls of the inner_discs()
};

/// Throws InputError, among others where no gap gives the coordination: `packing` is build_packing(scene).
Bonding bonding_of(const Scene& scene, const Packing& packing);

/// Packing, bonds, masses. The bond gap or coordination is that of the whole packing; then the bonds that cross an
/// edge which is not periodic are cut. Throws InputError.
ddem::Assembly build_assembly(const Scene& scene);

/// The same, in one piece: for statics. Bonds that the scene lists may leave pieces apart, which then is an InputError.
ddem::Assembly build_network(const Scene& scene);

struct LaterallyClosed {
  std::optional<ddem::Assembly> assembly;
  std::string missing;  ///< why there is none, and what would help
};

/// The same material without free edges above and below: the random packing closed in y, or a lattice of as many rows as it
/// takes. None of a packing from a file that does not close: without a width to serve as its period, with bonds of its own,
/// whose discs would overlap through the period or do not reach each other; none of a random packing too narrow for a
/// period. Of a packing between four flat walls the counterpart is another packing of the same seed, radii distribution and
/// coordination, with walls at its ends only. Its moduli are what a P or shear wave between periodic edges sees.
LaterallyClosed build_laterally_closed(const Scene& scene);

ContactParameters contact_parameters(const Scene& scene);
DeformationParameters deformation_parameters(const Scene& scene);

/// edge_band in metres.
double edge_band(const Scene& scene, const ddem::Assembly& assembly);

}  // namespace ddem::harness
