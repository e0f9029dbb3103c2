#pragma once
// Two discs that are not bonded and press against each other; see new_contacts.h.

#include "dem/kernel/step_data.h"

namespace ddem {

/// At places in the solver's order; displacements and strains: arrays of kQuad doubles a disc.
struct NewContact {
  int i = 0, j = 0;
  double nx = 0.0, ny = 0.0;  ///< from i to j
  double stretch = 1.0;       ///< distance over the sum of the radii
  double stiffness = 0.0;     ///< k_n, N/m
  double start_gap = 0.0;     ///< of the undisplaced discs, m
  double rigid_gap = 0.0;     ///< without the strains, m
  double gap = 0.0;           ///< m, negative

  /// On i along n, on j against it, N.
  double force() const { return stiffness * gap; }
  /// The gap of rigid discs elsewhere; linear kinematics.
  double rigid_gap_at(const double* motion) const {
    const double *a = motion + kQuad * i, *b = motion + kQuad * j;
    return start_gap + (nx * (b[0] - a[0]) + ny * (b[1] - a[1]));
  }
  /// How far strains move the boundaries towards each other, m.
  double approach(const double* strain) const {
    const double *a = strain + kQuad * i, *b = strain + kQuad * j;
    return stretch * (nx * nx * (a[0] + b[0]) + ny * ny * (a[1] + b[1]) + 2.0 * nx * ny * (a[2] + b[2]));
  }
};

}  // namespace ddem
