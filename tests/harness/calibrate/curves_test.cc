// Design curves of the lattice, where static moduli and kinematic estimate are the same closed form.
#include "harness/calibrate/curves.h"

#include <cmath>

#include "reports/svg.h"
#include "tests/harness/calibrate/scenes.h"

namespace ddem::harness::test {
namespace {

TEST(DesignCurves, OfTheLatticeAreItsClosedForm) {
  const Scene scene = lattice_scene("implicit", "full");
  int told = 0;
  const auto curves =
      design_curves(scene, {.seeds = 1, .softness = 0.3, .particle_poisson_ratio = 0.4}, [&] { ++told; });
  ASSERT_EQ(curves.size(), 2u);
  EXPECT_EQ(curve_count(scene), 2u);
  EXPECT_EQ(told, 2);
  EXPECT_FALSE(curves[0].deformable);
  EXPECT_EQ(curves[1].model, "DDEM F");
  for (const DesignCurve& c : curves) {
    EXPECT_EQ(c.points.front().stiffness_ratio, 0.0);
    EXPECT_NEAR(c.points.back().stiffness_ratio, 1.0, 1e-15);
    for (const CurvePoint& p : c.points) {
      EXPECT_NEAR(p.poisson.mean, p.kinematic_poisson, 1e-11);
      EXPECT_NEAR(p.young.mean / p.kinematic_young, 1.0, 1e-11);
    }
  }
  for (const CurvePoint& p : curves[0].points) {
    EXPECT_NEAR(p.poisson.mean, (1.0 - p.stiffness_ratio) / (3.0 + p.stiffness_ratio), 1e-11);
    EXPECT_NEAR(p.young.mean, std::sqrt(3.0) * (1.0 - p.poisson.mean), 1e-11);
  }
  EXPECT_NE(reports::render_svg(curve_figure(curves)).find("</svg>"), std::string::npos);
  const std::string csv = curve_csv(curves);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'),
            1 + static_cast<long>(curves[0].points.size() + curves[1].points.size()));
}

}  // namespace
}  // namespace ddem::harness::test
