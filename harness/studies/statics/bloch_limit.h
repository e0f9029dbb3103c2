#pragma once
// Wave speeds of the lattice from its plane waves: neither a time step nor a static solve.

#include "dem/core/material.h"
#include "dem/spectra/bloch.h"

namespace ddem::harness {

/// omega/k of the two acoustic waves along x as k goes to 0.
struct BlochLimit {
  double shear = 0.0, p = 0.0;  ///< m/s
  double seconds = 0.0;         ///< wall time
};

/// Relative error below 1e-8, see there; strains are those of the equilibrium, whatever the scheme. Throws as
/// HexagonalBloch.
BlochLimit bloch_limit(const ddem::HexagonalLattice& lattice, const ContactParameters& contact,
                       const DeformationParameters& deformation);

}  // namespace ddem::harness
