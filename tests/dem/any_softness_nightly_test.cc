// Implicit strains have no limit of softness: 1e5 steps from noise, close to the critical step of the rigid discs.

#include <gtest/gtest.h>

#include <string>

#include "dem/simulation/simulation.h"
#include "dem/spectra/spectra.h"
#include "tests/support/assemblies.h"

namespace ddem {
namespace {

using test::kNormalStiffness;

struct Softness {
  std::string name;
  double value;  ///< k_n/E_p
};

class AnySoftness : public testing::TestWithParam<Softness> {};
INSTANTIATE_TEST_SUITE_P(Discs, AnySoftness,
                         testing::Values(Softness{"p01", 0.01}, Softness{"p1", 0.1}, Softness{"1", 1.0}, Softness{"10", 10.0}, Softness{"100", 100.0}),
                         [](const auto& p) { return p.param.name; });

void expect_no_growth(const Assembly& a, Correction c, double softness) {
  SimulationInput in;
  in.contact = {kNormalStiffness, 0.5, Kinematics::linear};
  in.deformation = {Scheme::implicit, c, kNormalStiffness / softness, 0.3, Plane::stress};
  in.time_step = 0.9 * 2.0 / largest_frequency(a, in.contact, {});
  in.steps = 100000;
  in.initial.ux = test::Noise(3).vector(a.size(), 1e-9);
  in.initial.uy = test::Noise(4).vector(a.size(), 1e-9);
  const SimulationResult r = simulate(a, in);
  EXPECT_FALSE(r.breakdown.has_value());
  // Round-off of 1e5 steps, a hundred applications each at most: 1e-16 times the root of 1e7.
  EXPECT_LT(r.energy_drift.value_or(1.0), 1e-11);
}

TEST_P(AnySoftness, HexagonalDoesNotGrow) {
  const Assembly a = test::hexagonal_assembly({.columns = 34, .rows = 20, .radius = 1e-4, .periodic_x = true, .periodic_y = true});
  expect_no_growth(a, Correction::full, GetParam().value);
}

TEST_P(AnySoftness, RandomDoesNotGrow) {
  const Assembly a = test::random_free_strip();
  expect_no_growth(a, Correction::full, GetParam().value);
  expect_no_growth(a, Correction::normal_only_stress, GetParam().value);
}

}  // namespace
}  // namespace ddem
