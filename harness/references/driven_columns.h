#pragma once
// A driven pulse in the hexagonal lattice, exactly: what dispersion of the lattice does to it.

#include <Eigen/Core>
#include <span>
#include <vector>

namespace ddem::references {

/// Touching discs without strain of their own (DEM), close-packed rows along x, periodic in y. In a plane wave along x
/// all discs of a column move alike, and columns lie a radius apart.
struct HexagonalColumns {
  int columns = 0;                ///< twice the discs in a row
  double normal_stiffness = 0.0;  ///< k_n, N/m
  double stiffness_ratio = 0.0;   ///< k_t / k_n
  double disc_mass = 0.0;         ///< kg
};

enum class ColumnWave { p, shear };

/// The strip at rest whose first two columns move as sin^2(pi t/duration), 0 <= t <= duration, along x (p) or y (shear);
/// rotations are free, and so is the right end. Columns j and j + 1 are joined by two bonds a disc at +-60 degrees,
/// j and j + 2 by one along x:
///   shear  (3/4) k_n dv^2 + k_t (dv/2 - phi_j - phi_j+1)^2   and   k_t/2 (dv - phi_j - phi_j+2)^2,   phi = r theta,
///   P      (k_n + 3 k_t)/4 du^2                              and   k_n/2 du^2.
/// Solved by the modes of this chain, in closed form in time: no time step, no wavelength that would be long enough.
class DrivenColumns {
 public:
  /// Throws std::invalid_argument with fewer than four columns or values that are not positive and finite (k_t may be 0).
  DrivenColumns(const HexagonalColumns& lattice, ColumnWave wave, double duration);

  /// sum_j weights[j] u_j at t = n dt, n = 0 .. samples - 1, for unit amplitude; one weight a column.
  std::vector<double> signal(std::span<const double> weights, double dt, std::size_t samples) const;

 private:
  int columns_ = 0;
  double duration_ = 0.0;
  Eigen::VectorXd frequency_;  ///< of the modes, rad/s
  Eigen::VectorXd load_;       ///< what the drive puts into each
  Eigen::MatrixXd shape_;      ///< displacement of the columns behind the driven ones in each mode
};

}  // namespace ddem::references
