// Flutter of the published correction against the dense eigenvalues of a small random packing.

#include "dem/spectra/flutter.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

#include "dem/spectra/dense_eigen.h"
#include "dem/spectra/scheme_stiffness.h"
#include "meshes/packings/random.h"
#include "tests/support/assemblies.h"

namespace ddem {
namespace {

using test::kNormalStiffness;

ContactParameters contact(double lambda) { return {kNormalStiffness, lambda, Kinematics::linear}; }

DeformationParameters strains(Correction c) { return {Scheme::implicit, c, 4.0 * kNormalStiffness, 0.3, Plane::stress}; }

Assembly small_random() {
  const Packing p = packings::random_jammed({.length = 2.6e-3, .width = 2e-3, .discs = 100, .seed = 1});
  return make_assembly(p, bonds_within_gap(p, 0.3 * mean_radius(p)), 1.0, test::kDensity, RattlerRule::peel);
}

/// Largest imaginary part of all frequencies, over the largest real part.
double dense_flutter(const Assembly& a, double lambda, Correction c) {
  const Operators op = make_operators(a, contact(lambda), strains(c));
  const SchemeStiffness stiffness = SchemeStiffness::converged(op);
  const Eigen::VectorXd s = mass_scaling(op, {});
  Eigen::MatrixXd m(s.size(), s.size());
  for (Eigen::Index k = 0; k < s.size(); ++k) {
    m.col(k) = s.cwiseProduct(stiffness.apply(s[k] * Eigen::VectorXd::Unit(s.size(), k)));
  }
  double real = 0.0, imaginary = 0.0;
  const Eigen::VectorXcd all = eigenvalues(m, "flutter");
  for (const std::complex<double>& squared : all) {
    const std::complex<double> omega = std::sqrt(squared);
    real = std::max(real, omega.real());
    // The rigid translations are a zero eigenvalue up to round-off, whose root may be imaginary.
    if (std::abs(squared) > 1e-10 * m.norm()) imaginary = std::max(imaginary, std::abs(omega.imag()));
  }
  return imaginary / real;
}

TEST(Flutter, OfTheDenseEigenvalues) {
  const Assembly a = small_random();
  for (const double lambda : {0.25, 1.0}) {
    const FlutterSearch search = find_flutter(a, contact(lambda), strains(Correction::normal), {});
    ASSERT_TRUE(search.frequency.has_value());
    const double growth = search.frequency->imag() / search.largest_frequency;
    EXPECT_GT(growth, search.detectable);
    // Eigenvectors converge to 1e-3 in 3000 steps, which tell growth of 1 part in 3000 apart.
    EXPECT_NEAR(growth / dense_flutter(a, lambda, Correction::normal), 1.0, 0.01);
  }
}

TEST(Flutter, NotWhereThereIsAnEnergyNorInTheLattice) {
  const Assembly random = small_random();
  for (const Correction c : {Correction::full, Correction::normal_only_stress}) {
    EXPECT_FALSE(find_flutter(random, contact(0.5), strains(c), {}).frequency.has_value());
  }
  EXPECT_FALSE(find_flutter(random, contact(0.0), strains(Correction::normal), {}).frequency.has_value());
  const Assembly lattice = test::hexagonal_assembly({.columns = 6, .rows = 6, .radius = 1e-4, .periodic_x = true, .periodic_y = true});
  EXPECT_FALSE(find_flutter(lattice, contact(0.5), strains(Correction::normal), {}).frequency.has_value());
}

}  // namespace
}  // namespace ddem
