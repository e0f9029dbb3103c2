#pragma once
// Frictionless soft discs in a periodic cell, relaxed to a minimum of their energy sum_c overlap_c^2 / 2.

#include <cstddef>
#include <vector>

#include "dem/core/packing.h"

namespace ddem::packings {

class SoftDiscs {
 public:
  /// What the contacts look like where the minimiser stopped.
  struct State {
    double mean_overlap = 0.0, largest_overlap = 0.0;  ///< m; forces as well, with unit stiffness
    double unbalanced_force = 0.0;  ///< largest net force on a disc over the mean contact force
    int contacts = 0;
    int iterations = 0;
    bool converged = false;
  };

  struct Goal {
    double unbalanced_force;  ///< converged when no larger than this,
    double overlap;           ///< or when the largest overlap (m) is no larger than this: nothing touches
    int most_iterations;
  };

  /// `start` holds the centres, the radii and both periods.
  explicit SoftDiscs(Packing start);

  const Packing& packing() const { return packing_; }

  void scale_radii(double factor);

  /// FIRE (Bitzek et al., Phys. Rev. Lett. 97, 170201, 2006): damped dynamics that turn off their inertia
  /// whenever it points uphill. Unit masses.
  State minimise(const Goal& goal);

 private:
  /// A neighbour of a disc; the shift to its nearest image is fixed while the list is valid.
  struct Neighbour {
    int disc;
    double shift_x, shift_y;
    double radii;
  };

  /// Sums over the discs: F.v, F.F, v.v; and the largest F.F of a disc.
  struct Products {
    double power = 0.0, force2 = 0.0, velocity2 = 0.0, largest_force2 = 0.0;
  };

  void build_list();
  State evaluate_forces(Products& products);
  void advance(double dt, double keep, double push);

  Packing packing_;
  std::vector<double> vx_, vy_, fx_, fy_;
  std::vector<Neighbour> neighbours_;  ///< of disc i, with higher numbers: from first_[i] to first_[i + 1]
  std::vector<std::size_t> first_;
  std::vector<double> listed_x_, listed_y_;  ///< centres when the list was built
  double skin_ = 0.0;
};

}  // namespace ddem::packings
