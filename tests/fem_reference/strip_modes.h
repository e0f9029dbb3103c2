#pragma once
// All symmetric waves of a strip with free edges, exact along the strip and in time: what a pulse along x becomes that is
// uniform over the height at the start.

#include <Eigen/Core>

#include "fem_reference/kernel/material.h"

namespace ddem::fem::test {

/// Waves u_x = U(y) sin(k x), u_y = V(y) cos(k x), y from the middle, U even and V odd: eigenvectors of the energy
/// 1/2 int [(lambda + 2 mu)(k^2 U^2 + V'^2) + 2 lambda k U V' + mu (U' - k V)^2] dy on spectral elements of degree 8 over
/// half the width. The lowest is Rayleigh and Lamb's S0.
class StripModes {
 public:
  StripModes(const PlaneMaterial& material, double width, double wave_number, int elements);

  double lowest_frequency() const { return frequency_[0]; }
  /// u_x of the strip that starts from rest with u_x = sin(k x), u_y = 0, over sin(k x), is the product of one of the
  /// following with cos(frequency t): its mean over the height, and at |y| <= width/2 from the middle.
  const Eigen::VectorXd& frequency() const { return frequency_; }
  const Eigen::VectorXd& mean() const { return mean_; }
  Eigen::VectorXd at(double y) const;

 private:
  double element_width_;
  Eigen::VectorXd frequency_, mean_;
  Eigen::MatrixXd shape_;  ///< U of all nodes, times the mode's share in the start
};

}  // namespace ddem::fem::test
