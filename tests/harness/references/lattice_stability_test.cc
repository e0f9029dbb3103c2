// Exact limits of the hexagonal lattice against the spectral radius of K B of a periodic patch, assembled
// here.

#include "harness/references/lattice_stability.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "dem/spectra/dense_eigen.h"

namespace ddem::references {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;

constexpr int patch = 4;  // cells each way; the critical modes are uniform, so any size holds them
constexpr int discs = patch * patch, bonds = 3 * discs;

const Vector2d directions[3] = {
    {1.0, 0.0}, {0.5, 0.5 * std::numbers::sqrt3}, {-0.5, 0.5 * std::numbers::sqrt3}};

/// Disc at the far end of bond b of cell (x, y): lattice vectors are directions 0 and 1, the third is their
/// difference.
int neighbour(int x, int y, int b) {
  const int dx = b == 0 ? 1 : (b == 1 ? 0 : -1), dy = b == 0 ? 0 : 1;
  return (y + dy + patch) % patch * patch + (x + dx + patch) % patch;
}

/// K B: the forces (F_n, F_t of each bond, unit radius) answered to unit forces through the discs' strains.
MatrixXd force_to_force(ContactModel model, const Contact& contact, const PlaneConstants& material) {
  MatrixXd strain = MatrixXd::Zero(3 * discs, 2 * bonds);  // (xx, yy, xy) of each disc by the forces
  MatrixXd overlap =
      MatrixXd::Zero(2 * bonds, 3 * discs);  // correction of u_n, u_t by the strains, times stiffness
  const double E = material.young_modulus, nu = material.poisson_ratio;
  for (int y = 0; y < patch; ++y)
    for (int x = 0; x < patch; ++x)
      for (int b = 0; b < 3; ++b) {
        const int bond = 3 * (y * patch + x) + b;
        const Vector2d n = directions[b], t(-n.y(), n.x());
        for (const int disc : {y * patch + x, neighbour(x, y, b)}) {
          for (int component = 0; component < 2; ++component) {
            if (component == 1 && model == ContactModel::ddem_normal_only_stress) continue;
            // s (x) F is the same for both ends: s and F change sign together.
            const Vector2d f = component == 0 ? n : t;
            const double xx = n.x() * f.x() / std::numbers::pi, yy = n.y() * f.y() / std::numbers::pi;
            const double xy = 0.5 * (n.x() * f.y() + n.y() * f.x()) / std::numbers::pi;
            strain(3 * disc, 2 * bond + component) += (xx - nu * yy) / E;
            strain(3 * disc + 1, 2 * bond + component) += (yy - nu * xx) / E;
            strain(3 * disc + 2, 2 * bond + component) += (1.0 + nu) / E * xy;
          }
          const double k_n = contact.normal_stiffness, k_t = contact.stiffness_ratio * k_n;
          overlap.block<1, 3>(2 * bond, 3 * disc) +=
              k_n * Eigen::RowVector3d(n.x() * n.x(), n.y() * n.y(), 2.0 * n.x() * n.y());
          if (model == ContactModel::ddem_full)
            overlap.block<1, 3>(2 * bond + 1, 3 * disc) +=
                k_t * Eigen::RowVector3d(t.x() * n.x(), t.y() * n.y(), t.x() * n.y() + t.y() * n.x());
        }
      }
  return strain * overlap;  // 3 discs square: the same nonzero eigenvalues as overlap * strain
}

double spectral_radius(const MatrixXd& matrix) {
  return eigenvalues(matrix, "force to force").cwiseAbs().maxCoeff();
}

TEST(LatticeStability, FixedPointRadiusIsThatOfTheLattice) {
  for (const ContactModel model :
       {ContactModel::ddem_normal, ContactModel::ddem_full, ContactModel::ddem_normal_only_stress})
    for (const double lambda : {0.0, 0.3, 0.5, 1.0})
      for (const double nu : {0.0, 0.3, 0.49}) {
        const Contact contact{1.0, lambda};
        const Disc disc{{4.0, nu}, 1.0};
        // Eigenvalues of a well-conditioned matrix of 48: round-off, 1e-12.
        EXPECT_NEAR(hexagonal_fixed_point_radius(model, contact, disc),
                    spectral_radius(force_to_force(model, contact, disc.material)), 1e-12)
            << static_cast<int>(model) << ' ' << lambda << ' ' << nu;
      }
}

TEST(LatticeStability, KnownLimits) {
  EXPECT_NEAR(hexagonal_fixed_point_limit(ContactModel::ddem_normal, 0.3, 0.5), 0.748, 5e-4);
  EXPECT_NEAR(hexagonal_fixed_point_limit(ContactModel::ddem_full, 0.3, 0.5), 0.537, 5e-4);
  EXPECT_NEAR(hexagonal_fixed_point_radius(ContactModel::ddem_full, {0.25, 0.0}, {{1.0, 0.3}, 1.0}), 0.334225,
              5e-7);
  EXPECT_NEAR(hexagonal_fixed_point_radius(ContactModel::ddem_full, {0.25, 0.0}, {{1.0, 0.3}, 0.5}), 0.66845,
              1e-6);
  EXPECT_THROW(hexagonal_fixed_point_limit(ContactModel::dem, 0.3, 0.5), std::invalid_argument);
  EXPECT_THROW(hexagonal_fixed_point_limit(ContactModel::ddem_full, 1.3, 0.5), std::invalid_argument);
}

TEST(LatticeStability, CriticalStepIsThatOfTheBlochSpectrum) {
  // omega^2 = lambda_max(sum_b 4 k sin^2(k.d_b/2) n_b n_b)/m over a grid of the Brillouin zone that holds its
  // M points, where it is largest: phases (2 pi i/n, 2 pi j/n) along the lattice vectors.
  constexpr int grid = 60;
  double largest = 0.0;
  for (int i = 0; i < grid; ++i)
    for (int j = 0; j < grid; ++j) {
      const double phase[3] = {2.0 * std::numbers::pi * i / grid, 2.0 * std::numbers::pi * j / grid,
                               2.0 * std::numbers::pi * (j - i) / grid};
      Eigen::Matrix2d dynamic = Eigen::Matrix2d::Zero();
      for (int b = 0; b < 3; ++b) {
        const double sine = std::sin(0.5 * phase[b]);
        dynamic += 4.0 * sine * sine * directions[b] * directions[b].transpose();
      }
      largest = std::max(largest, symmetric_eigenvalues(MatrixXd(dynamic), "lattice").maxCoeff());
    }
  const double k = 1e10, m = 1.1e-4;
  EXPECT_NEAR(hexagonal_critical_step(k, m) * std::sqrt(largest * k / m) / 2.0, 1.0, 1e-12);
  EXPECT_THROW(hexagonal_critical_step(0.0, m), std::invalid_argument);
}

}  // namespace
}  // namespace ddem::references
