// A driven pulse in the lattice: what any solution of the chain must satisfy.

#include "harness/references/driven_columns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "harness/references/effective_moduli.h"

namespace ddem::references {
namespace {

constexpr double kStiffness = 1e10, kMass = 8e-5;

/// Long-wave speed in columns (radii) a second, from the closed forms: c^2 = G/rho, (K + G)/rho, the mass of a disc on
/// 2 sqrt(3) r^2.
double columns_per_second(ColumnWave wave, double ratio) {
  const PlaneModuli m = effective_moduli(ContactModel::dem, hexagonal_fabric(), {kStiffness, ratio}, {});
  const double modulus = wave == ColumnWave::shear ? m.shear : m.bulk + m.shear;
  return std::sqrt(modulus * 2.0 * std::sqrt(3.0) / kMass);
}

std::vector<double> column_weight(int columns, int column) {
  std::vector<double> w(columns, 0.0);
  w[column] = 1.0;
  return w;
}

struct Moments {
  double area, mean;
};

Moments moments(const std::vector<double>& u, double dt) {
  double area = 0.0, first = 0.0;
  for (std::size_t n = 0; n < u.size(); ++n) area += u[n] * dt, first += u[n] * dt * static_cast<double>(n) * dt;
  return {area, first / area};
}

/// The first moment of a pulse that runs through a medium without reflection travels at the speed of infinitely long waves,
/// whatever the dispersion: d phase/d omega at 0. The sum over samples of a smooth pulse is exact to round-off, what is
/// left is the tail that the window cuts off.
TEST(DrivenColumns, CentroidTravelsAtTheClosedForm) {
  constexpr int columns = 400;
  for (const double ratio : {0.0, 0.3, 1.0}) {
    for (const ColumnWave wave : {ColumnWave::shear, ColumnWave::p}) {
      const double c = columns_per_second(wave, ratio);
      const double duration = 60.0 / c;
      const DrivenColumns strip({columns, kStiffness, ratio, kMass}, wave, duration);
      // The front comes back to column 200 after 600 columns' time; the pulse has passed after 260, its tail with 500.
      const double dt = duration / 100.0;
      const auto samples = static_cast<std::size_t>(500.0 / c / dt);
      const Moments near = moments(strip.signal(column_weight(columns, 50), dt, samples), dt);
      const Moments far = moments(strip.signal(column_weight(columns, 200), dt, samples), dt);
      EXPECT_NEAR((far.mean - near.mean) * c, 150.0, 150.0 * 2e-5) << ratio;
      EXPECT_NEAR(near.area / (0.5 * duration), 1.0, 1e-4);
      EXPECT_NEAR(far.area / (0.5 * duration), 1.0, 1e-4);
    }
  }
}

/// In time, Newton's law at a column inside, k_t = 0, from differences of the samples: m u'' = k (u_- - 2 u + u_+), P with
/// the bonds along x in addition. Central differences err by (w dt)^2/12, w up to 2 pi 3/duration: 3e-5 at 1000 samples.
TEST(DrivenColumns, ObeyNewtonsLaw) {
  constexpr int columns = 40;
  const double duration = 12.0 / columns_per_second(ColumnWave::p, 0.0);
  const double dt = duration / 1000.0;
  for (const ColumnWave wave : {ColumnWave::shear, ColumnWave::p}) {
    const DrivenColumns strip({columns, kStiffness, 0.0, kMass}, wave, duration);
    const double near = (wave == ColumnWave::p ? 0.5 : 1.5) * kStiffness, far = wave == ColumnWave::p ? kStiffness : 0.0;
    std::vector<double> weights(columns, 0.0), one = column_weight(columns, 5);
    weights[5] = -2.0 * (near + far), weights[4] = weights[6] = near, weights[3] = weights[7] = far;
    const auto u = strip.signal(one, dt, 2000), force = strip.signal(weights, dt, 2000);
    double largest = 0.0, error = 0.0;
    for (std::size_t n = 1; n + 1 < u.size(); ++n) {
      largest = std::max(largest, std::abs(force[n]));
      error = std::max(error, std::abs(kMass * (u[n - 1] - 2.0 * u[n] + u[n + 1]) / (dt * dt) - force[n]));
    }
    EXPECT_GT(largest, 0.0);
    EXPECT_LT(error, 1e-4 * largest);
  }
}

TEST(DrivenColumns, TheDrivenColumnsMoveAsPrescribed) {
  const double duration = 1e-6, dt = 1e-8;
  const DrivenColumns strip({20, kStiffness, 0.5, kMass}, ColumnWave::shear, duration);
  const auto u = strip.signal(column_weight(20, 1), dt, 150);
  for (std::size_t n = 0; n < u.size(); ++n) {
    const double t = static_cast<double>(n) * dt;
    EXPECT_NEAR(u[n], t < duration ? std::pow(std::sin(std::numbers::pi * t / duration), 2) : 0.0, 1e-12);
  }
}

TEST(DrivenColumns, RefuseWhatIsNoStrip) {
  EXPECT_THROW(DrivenColumns({3, kStiffness, 0.5, kMass}, ColumnWave::p, 1.0), std::invalid_argument);
  EXPECT_THROW(DrivenColumns({20, -1.0, 0.5, kMass}, ColumnWave::p, 1.0), std::invalid_argument);
  EXPECT_THROW(DrivenColumns({20, kStiffness, -0.5, kMass}, ColumnWave::p, 1.0), std::invalid_argument);
  EXPECT_THROW(DrivenColumns({20, kStiffness, 0.5, kMass}, ColumnWave::p, 0.0), std::invalid_argument);
  const DrivenColumns strip({20, kStiffness, 0.5, kMass}, ColumnWave::p, 1e-6);
  EXPECT_THROW(strip.signal(std::vector<double>(19, 0.0), 1e-8, 10), std::invalid_argument);
}

}  // namespace
}  // namespace ddem::references
