#pragma once
// Plane waves in the infinite hexagonal lattice of equal touching discs, exact at every wavelength and time step.
//
// With u(x, t) = U exp(i k.x) the operators of theory section 1 become those of one cell: one disc, three bonds along
// d_b = 2 r n_b, two or three degrees of freedom, three strain unknowns. With f_b = exp(i k.d_b):
//   C: u_n = n.(f_b - 1) U,  u_t = t.(f_b - 1) U - r (1 + f_b) theta
//   G: a strain adds r (1 + f_b) n.eps.n to u_n and, for F, r (1 + f_b) t.eps.n to u_t
//   S: conjugate transpose of that, over the overlaps whose forces make the stress.
// Converged strains give M w^2 U = C^H K (1 - G (V C_p + S K G)^-1 S K) C U; the lagged scheme is a linear map of
// (u, dt v, eps), whose eigenvalues z are the factors by which its waves grow in a step.

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <vector>

#include "dem/core/material.h"

namespace ddem {

/// Of a step: what grows less does not grow. Round-off of an eigenvalue near a double one is 1e-16/(omega dt), 1e-12 here.
inline constexpr double kNoGrowth = 1e-9;

/// The lattice: one of its three lines of touching discs lies at `row_angle` (rad) to the x axis, which is 0 for
/// close-packed rows along x and pi/2 (or pi/6) for rows along y.
struct HexagonalLattice {
  double radius = 0.0;     ///< m
  double density = 0.0;    ///< of a disc, kg/m3
  double thickness = 1.0;  ///< m
  double row_angle = 0.0;
};

/// 1/m.
struct WaveVector {
  double x = 0.0, y = 0.0;
};

/// A free wave: its angular frequency (rad/s) and its motion (u_x, u_y, r theta) per root of the energy, |motion| = 1.
struct Branch {
  std::complex<double> frequency;
  Eigen::VectorXcd motion;
};

/// A free wave of the scheme: Re(z^n motion exp(i k.x)), z its factor a step, the motion of a disc as in Branch.
struct WaveMode {
  std::complex<double> factor;
  Eigen::VectorXcd motion;
};

/// Where in the zone of wave vectors the scheme grows most.
struct WorstWave {
  double growth = 0.0;  ///< |z| - 1 of a step, negative where every wave decays
  WaveVector wave;
};

class HexagonalBloch {
 public:
  /// Throws std::invalid_argument unless radius, density, thickness and stiffness (and E_p) are positive.
  HexagonalBloch(const HexagonalLattice& lattice, const ContactParameters& contact,
                 const DeformationParameters& deformation);

  int dofs() const { return dofs_; }

  /// Angular frequencies (rad/s) of plain DEM, or with converged strains, in ascending order of their real part: one a
  /// degree of freedom, the slowest two being S and P at long waves. Real for corrections that derive from an energy; a
  /// pair of complex ones flutters.
  std::vector<std::complex<double>> frequencies(WaveVector k) const;

  /// The same with their motions, which tell shear, longitudinal and rotational waves apart.
  std::vector<Branch> branches(WaveVector k) const;

  /// Factors z of one step `dt` (s): two a degree of freedom, and three of the strains for the lagged scheme.
  std::vector<std::complex<double>> multipliers(WaveVector k, double dt) const;

  /// The same with their motions. Lagged strains have modes without motion, whose factors are those of the strains alone.
  std::vector<WaveMode> modes(WaveVector k, double dt) const;

  /// Of multipliers(k, dt), the one that continues the frequency: nearest to exp(i omega dt).
  std::complex<double> multiplier_of(WaveVector k, double dt, double frequency) const;

  /// Largest |z| - 1 of a wave.
  double growth(WaveVector k, double dt) const;

  /// The wave that grows most: of a grid of the zone (24 x 24, with its corners and edge centres, and next to its centre), and
  /// then of ever finer ones around it.
  WorstWave worst_wave(double dt) const;

  /// Largest step at which no wave grows, s; none where every step grows. Growth below 1e-9 a step counts as
  /// none. Relative accuracy 1e-4.
  std::optional<double> largest_stable_step() const;

 private:
  using Matrix = Eigen::MatrixXcd;
  struct Cell {
    Matrix overlap, strain_overlap, stress;  ///< C, G, S of a wave vector
  };
  Cell cell(WaveVector k) const;
  Matrix converged_stiffness(const Cell& c) const;
  Matrix lagged_map(const Cell& c, double dt) const;
  Matrix scaled_stiffness(WaveVector k) const;  ///< M^-1/2 K_eff M^-1/2
  bool conserves() const;
  Eigen::VectorXcd squared_frequencies(WaveVector k) const;

  HexagonalLattice lattice_;
  DeformationParameters deformation_;
  int dofs_ = 2, rows_ = 1;             ///< a disc; a bond
  Eigen::VectorXd stiffness_;           ///< diagonal of K, N/m
  Eigen::VectorXd inverse_mass_;        ///< of (u_x, u_y, r theta), 1/kg
  Eigen::Matrix3d strain_stiffness_;    ///< V C_p / r^2, N/m: strains are scaled by the radius
};

}  // namespace ddem
