// What distinguishes the schemes: implicit strains allow any softness and lose no energy, lagged ones damp, and an even
// number of lagged evaluations feeds (theory section 3).

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dem/simulation/simulation.h"
#include "dem/spectra/spectra.h"
#include "tests/support/assemblies.h"

namespace ddem {
namespace {

using test::kNormalStiffness;

Assembly lattice() {
  return test::hexagonal_assembly({.columns = 16, .rows = 16, .radius = 1e-4, .periodic_x = true, .periodic_y = true});
}

SimulationInput noise_input(const Assembly& a, const DeformationParameters& d, double fraction, long steps) {
  SimulationInput in;
  in.contact = {kNormalStiffness, 0.5, Kinematics::linear};
  in.deformation = d;
  in.time_step = fraction * 2.0 / largest_frequency(a, in.contact, {});
  in.steps = steps;
  in.initial.ux = test::Noise(3).vector(a.size(), 1e-9);
  in.initial.uy = test::Noise(4).vector(a.size(), 1e-9);
  return in;
}

TEST(ImplicitStrains, NoGrowthAtAnySoftness) {
  const Assembly free = test::random_free_strip(), periodic = lattice();
  for (const Assembly* a : {&free, &periodic}) {
    for (const double softness : {0.01, 1.0, 100.0}) {
      const DeformationParameters d{Scheme::implicit, Correction::full, kNormalStiffness / softness, 0.3, Plane::stress};
      const SimulationResult r = simulate(*a, noise_input(*a, d, 0.9, 1000));
      ASSERT_FALSE(r.breakdown.has_value()) << softness;
      EXPECT_LT(r.energy_drift.value(), 1e-12) << softness;
    }
  }
}

TEST(LaggedStrains, DivergeBeyondTheirLimit) {
  const Assembly a = lattice();
  const DeformationParameters d{Scheme::lagged, Correction::full, kNormalStiffness, 0.3, Plane::stress};
  EXPECT_TRUE(simulate(a, noise_input(a, d, 0.2, 2000)).breakdown.has_value());
}

/// Amplitude of a plane shear wave with wave vector along x, one wavelength over the lattice, after `steps`, over what it
/// was: growth of the largest displacement over a period.
double amplitude_ratio(int evaluations, double relaxation, Scheme scheme) {
  const Assembly a = lattice();
  SimulationInput in;
  in.contact = {kNormalStiffness, 0.5, Kinematics::linear};
  in.deformation = {scheme, Correction::full, 4.0 * kNormalStiffness, 0.3, Plane::stress};
  in.deformation.evaluations = evaluations;
  in.deformation.relaxation = relaxation;
  in.time_step = 0.1 * 2.0 / largest_frequency(a, in.contact, {});
  in.steps = 6000;
  const double k = 2.0 * std::numbers::pi / a.packing.period.x;
  for (std::size_t d = 0; d < a.size(); ++d) in.initial.uy.push_back(1e-9 * std::cos(k * a.packing.x[d]));
  in.receivers = {{{0}}};
  const std::vector<double> u = simulate(a, in).signals.uy[0];
  const auto largest = [&](std::size_t from, std::size_t to) {
    double m = 0.0;
    for (std::size_t n = from; n < to; ++n) m = std::max(m, std::abs(u[n]));
    return m;
  };
  return largest(5000, 6000) / largest(0, 1000);
}

TEST(LaggedStrains, DampWithOneEvaluationAndFeedWithTwo) {
  const double one = amplitude_ratio(1, 1.0, Scheme::lagged), two = amplitude_ratio(2, 1.0, Scheme::lagged);
  const double implicit = amplitude_ratio(1, 1.0, Scheme::implicit);
  EXPECT_LT(one, 0.99);
  EXPECT_GT(two, 1.002);
  EXPECT_NEAR(implicit, 1.0, 1e-3);
}

}  // namespace
}  // namespace ddem
