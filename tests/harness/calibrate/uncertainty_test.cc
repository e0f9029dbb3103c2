// Uncertainty of the target in the parameters: against calibrations of shifted targets.
#include <cmath>

#include "tests/harness/calibrate/scenes.h"

namespace ddem::harness::test {
namespace {

Target uncertain_target(double young, double young_stddev, double poisson, double poisson_stddev) {
  WantedValues wanted;
  wanted.of(TargetKind::young) = Uncertain{young, young_stddev};
  wanted.of(TargetKind::poisson) = Uncertain{poisson, poisson_stddev};
  return make_target(wanted);
}

/// On the lattice lambda = (1 - 3 nu)/(1 + nu): d(lambda) = -4/(1 + nu)^2 d(nu). E = (sqrt 3/2) (1 - nu)
/// k_n... with 2K = sqrt(3) k_n: E = 2K (1 - nu), so d(ln k_n) = d(ln E) + d(nu)/(1 - nu).
TEST(Uncertainty, IsTheLatticesClosedForm) {
  const double nu = 0.25, s_nu = 0.01, s_young = 0.03;
  const Calibration c = calibrate(lattice_scene(), uncertain_target(30e9, s_young * 30e9, nu, s_nu), {});
  EXPECT_EQ(c.found.solved_for, Parameter::stiffness_ratio);
  EXPECT_NEAR(c.found.solved_stddev, 4.0 / (1.25 * 1.25) * s_nu, 1e-9);
  EXPECT_NEAR(c.found.stiffness_stddev / c.found.stiffness, std::hypot(s_young, s_nu / (1.0 - nu)), 1e-9);
}

/// Soft discs, the softness solved for: half the difference of the calibrations at nu -+ h, whose error is of
/// second order (h = 1e-4: relative 1e-5 for second derivatives of ten times the first squared).
TEST(Uncertainty, IsTheShiftOfACalibration) {
  const Scene scene = lattice_scene("implicit", "full");
  const CalibrationOptions options{held(0.2, {}, 0.45), 1, 1};
  const double h = 1e-4;
  const Calibration c = calibrate(scene, uncertain_target(30e9, 0.0, 0.35, h), options);
  ASSERT_TRUE(c.feasible);
  ASSERT_EQ(c.found.solved_for, Parameter::log_softness);
  const Calibration above = calibrate(scene, target_of(30e9, 0.35 + h), options),
                    below = calibrate(scene, target_of(30e9, 0.35 - h), options);
  EXPECT_NEAR(c.found.solved_stddev / (0.5 * (above.found.point.softness - below.found.point.softness)), 1.0,
              1e-4);
  EXPECT_NEAR(c.found.stiffness_stddev / (0.5 * (above.found.stiffness - below.found.stiffness)), 1.0, 1e-4);
}

TEST(Uncertainty, OfACertainTargetIsNone) {
  const Calibration c = calibrate(lattice_scene(), target_of(30e9, 0.25), {});
  EXPECT_EQ(c.found.solved_stddev, 0.0);
  EXPECT_EQ(c.found.stiffness_stddev, 0.0);
}

}  // namespace
}  // namespace ddem::harness::test
