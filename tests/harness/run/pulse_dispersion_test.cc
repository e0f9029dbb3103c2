// What a pulse loses to discs and steps: against the exact waves of the lattice, and against runs.

#include "harness/run/pulse_dispersion.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/spectra/bloch.h"
#include "harness/model/assemble.h"
#include "harness/references/column_release.h"
#include "harness/references/effective_moduli.h"
#include "harness/run/dem_run.h"
#include "harness/scene/read_scene.h"

namespace ddem::harness::test {
namespace {

using std::numbers::pi;
constexpr double kRadius = 1e-4;

/// 120 x 6 discs of 0.1 mm, close-packed rows along `rows`, periodic in y.
std::string strip(const std::string& load, const std::string& rows = "x", double ratio = 0.0, const std::string& time = "integrator = \"exact\"") {
  return fmt::format("[assembly]\npacking = \"hexagonal\"\ncolumns = 120\nrows = 6\nradius = {}\nclose_packed_along = \"{}\"\n[material]\ndensity = 2000\n"
                     "[contact]\nnormal_stiffness = 1e10\nstiffness_ratio = {}\n[boundary]\ntop_bottom = \"periodic\"\n{}\n[time]\n{}\n"
                     "[probes]\npairs = 3\nsection = true\n",
                     kRadius, rows, ratio, load, time);
}

Scene scene_of(const std::string& text) {
  const SceneResult scene = parse_scene(text, "scene.toml", ".", {Purpose::simulation});
  EXPECT_TRUE(scene) << to_string(scene.violations);
  return *scene;
}

std::string drive(const std::string& wave, double duration) { return fmt::format("[drive]\nwave = \"{}\"\nduration = {}\namplitude = 1e-8", wave, duration); }

/// The next order of sin(q)/q is q^4/120, q = k a/2: (k a)^4/1920, a at most a diameter here; twice that for two kinds of bonds.
TEST(PulseDispersion, OfALatticeIsThatOfItsExactWaves) {
  for (const char* rows : {"x", "y"}) {
    const Scene scene = scene_of(strip(drive("shear", 1e-6), rows));
    const ddem::Assembly a = build_assembly(scene);
    const ContactParameters contact = contact_parameters(scene);
    const HexagonalBloch bloch({kRadius, 2000.0, 1.0, *rows == 'x' ? 0.0 : pi / 2.0}, contact, {});
    const double spacing = *rows == 'x' ? kRadius : std::sqrt(3.0) * kRadius;
    const double shear = dispersion_area(a, contact, Wave::shear), p = dispersion_area(a, contact, Wave::longitudinal);
    const auto limit = bloch.frequencies({1.0, 0.0});  // at k = 1/m the speeds themselves
    for (const double kr : {0.05, 0.1, 0.2, 0.4}) {
      const double k = kr / kRadius, next = 2.0 * std::pow(k * 2.0 * kRadius, 4) / 1920.0;
      EXPECT_NEAR(1.0 - k * k * shear, references::chain_phase_speed(k * spacing), next) << rows << ", " << kr;
      const auto omega = bloch.frequencies({k, 0.0});
      EXPECT_NEAR(1.0 - k * k * shear, omega[0].real() / k / limit[0].real(), next) << rows << ", " << kr;
      EXPECT_NEAR(1.0 - k * k * p, omega[1].real() / k / limit[1].real(), next) << rows << ", " << kr;
    }
  }
}

/// With shear stiffness discs turn in shear waves, and their inertia slows them. Of (k r)^2 = 2.5e-3 the next order is 1 % at most.
TEST(PulseDispersion, OfALatticeWithShearStiffnessHasItsRotations) {
  for (const char* rows : {"x", "y"}) {
    for (const double ratio : {0.1, 0.3, 1.0}) {
      const Scene scene = scene_of(strip(drive("shear", 1e-6), rows, ratio));
      const ddem::Assembly a = build_assembly(scene);
      const ContactParameters contact = contact_parameters(scene);
      const HexagonalBloch bloch({kRadius, 2000.0, 1.0, *rows == 'x' ? 0.0 : pi / 2.0}, contact, {});
      const double k = 0.05 / kRadius;
      const auto lost = [&](std::size_t branch) { return 1.0 - bloch.frequencies({k, 0.0})[branch].real() / k / bloch.frequencies({1.0, 0.0})[branch].real(); };
      EXPECT_NEAR(k * k * dispersion_area(a, contact, Wave::shear) / lost(0), 1.0, 0.02) << rows << ratio;
      EXPECT_NEAR(k * k * dispersion_area(a, contact, Wave::longitudinal) / lost(1), 1.0, 0.02) << rows << ratio;
    }
  }
}

/// A bond of k_n in proportion to its size counts by it, and one across the wave not at all.
TEST(PulseDispersion, WeighsBondsByTheirStiffness) {
  ddem::Assembly a;
  a.packing.radius = {1.0, 1.0, 3.0};
  a.bonds.i = {0, 1}, a.bonds.j = {1, 2};
  a.bonds.nx = {1.0, 0.8}, a.bonds.ny = {0.0, 0.6}, a.bonds.length = {2.0, 5.0};
  const ContactParameters modulus{0.0, 0.5, Kinematics::linear, 2.0};  // k_n = 2 and 3
  const double w_0 = 2.0, w_1 = 3.0 * (0.64 + 0.5 * 0.36);
  EXPECT_NEAR(dispersion_area(a, modulus, Wave::longitudinal), (w_0 * 16.0 + w_1 * 256.0) / (24.0 * (w_0 * 4.0 + w_1 * 16.0)), 1e-14);
  const ContactParameters smooth{0.0, 0.0, Kinematics::linear, 2.0};
  const double v_1 = 3.0 * 0.36;  // of the first bond's, nothing
  EXPECT_NEAR(dispersion_area(a, smooth, Wave::shear), v_1 * 256.0 / (24.0 * v_1 * 16.0), 1e-14);
  a.bonds.nx = {0.0, 0.0}, a.bonds.ny = {1.0, 1.0};
  EXPECT_EQ(dispersion_area(a, smooth, Wave::shear), 0.0);
}

struct Pulse {
  double measured = 0.0, told = 0.0;  ///< shares of the static speed
  std::string warning;                ///< empty: none
};

Pulse run(const std::string& text) {
  const Scene scene = scene_of(text);
  const DemRun run = run_scene(scene);
  // In closed form: ends, whose bonds are missing, make the kinematic estimate of a strip a little slow.
  const auto m = references::effective_moduli(references::ContactModel::dem, references::hexagonal_fabric(), {1e10, scene.contact->stiffness_ratio}, {});
  const double modulus = *run.wave == Wave::shear ? m.shear : m.bulk + m.shear, density = 2000.0 * references::hexagonal_fabric().solid_fraction;
  const auto& measured = run.measurement.value().speed.speed;
  Pulse p{measured.ok() ? measured.value().mean / std::sqrt(modulus / density) - 1.0 : std::nan(""), pulse_dispersion(scene, run.assembly, run.context).value().total(), ""};
  for (const std::string& w : run.warnings) {
    if (w.find("dispersion") != std::string::npos) p.warning = w;
  }
  return p;
}

/// The number of "a drive.duration of 2 us" or "an initial.width of 2 mm".
double remedy_of(const std::string& warning) { return std::stod(warning.substr(warning.find(" of ", warning.find("static speed")) + 4)); }

/// A squared sine starts and ends with a jump of its curvature, which sends short waves; they lag behind and meet the top: it is off
/// by half to twice what is told. What the remedy makes is within the told 0.1 % and a half, and is not warned of.
TEST(PulseDispersion, OfADriveIsThatOfARun) {
  for (const auto& [wave, durations] : {std::pair{"shear", std::vector{0.9e-6, 1.1e-6}}, std::pair{"longitudinal", std::vector{0.9e-6, 1.2e-6}}}) {
    for (const double duration : durations) {
      const Pulse p = run(strip(drive(wave, duration)));
      EXPECT_GT(p.measured / p.told, 0.5) << wave << ", " << duration << ": " << p.measured << " " << p.told;
      EXPECT_LT(p.measured / p.told, 2.0) << wave << ", " << duration << ": " << p.measured << " " << p.told;
      ASSERT_THAT(p.warning, testing::StartsWith("drive.duration: the pulse is short for discs of this size")) << duration << ": " << p.told;
      EXPECT_THAT(p.warning, testing::HasSubstr(fmt::format("about {:.2g} % slower", -100.0 * p.told)));
      const Pulse longer = run(strip(drive(wave, 1e-6 * remedy_of(p.warning))));
      EXPECT_EQ(longer.warning, "");
      EXPECT_LT(std::abs(longer.told), 1e-3);
      EXPECT_LT(std::abs(longer.measured), 1.5e-3) << wave << ", " << duration;
    }
  }
}

/// A gaussian is smooth: within a quarter, of which pulses lose most by growing longer while they are measured.
TEST(PulseDispersion, OfAGaussianIsThatOfARun) {
  const auto released = [](const char* shape, double width) {
    return strip(fmt::format("[initial]\nwave = \"longitudinal\"\nshape = \"{}\"\nwidth = {}\namplitude = 1e-8", shape, width));
  };
  for (const double width : {7e-4, 9e-4, 1.1e-3}) {
    const Pulse p = run(released("gaussian", width));
    EXPECT_NEAR(p.measured / p.told, 1.0, 0.25) << width << ": " << p.measured << " " << p.told;
    ASSERT_THAT(p.warning, testing::StartsWith("initial.width: ")) << p.told;
    EXPECT_EQ(run(released("gaussian", 1e-3 * remedy_of(p.warning))).warning, "");
  }
  const Pulse cosine = run(released("cosine", 1.2e-3));
  EXPECT_GT(cosine.measured / cosine.told, 0.5);
  EXPECT_LT(cosine.measured / cosine.told, 2.0);
  EXPECT_THAT(cosine.warning, testing::StartsWith("initial.width: "));
}

/// Leapfrog near its critical step hastens waves: (omega dt)^2/24, which discs take back in part here.
TEST(PulseDispersion, OfStepsIsAddedToThatOfDiscs) {
  const std::string load = "[initial]\nwave = \"longitudinal\"\nshape = \"gaussian\"\nwidth = 8e-4\namplitude = 1e-8";
  const Pulse exact = run(strip(load)), marched = run(strip(load, "x", 0.0, "step_fraction = 0.99"));
  EXPECT_LT(exact.told, -4e-3);
  EXPECT_GT(marched.told, exact.told + 1e-3);
  EXPECT_NEAR((marched.measured - exact.measured) / (marched.told - exact.told), 1.0, 0.25);
}

TEST(PulseDispersion, IsNotToldOfLongPulsesAndColumns) {
  EXPECT_EQ(run(strip(drive("shear", 3e-6))).warning, "");
  const Scene column = scene_of(strip("[initial]\nwave = \"shear\"\namplitude = 1e-8"));
  const DemRun released = run_scene(column);
  EXPECT_FALSE(pulse_dispersion(column, released.assembly, released.context));
  EXPECT_TRUE(released.warnings.empty());
  // What no disc of the lattice could carry: the first order says nothing but that.
  const Scene tiny = scene_of(strip(drive("shear", 1e-7)));
  EXPECT_THAT(run_scene(tiny).warnings, testing::Contains(testing::HasSubstr("10 % or more slower")));
}

}  // namespace
}  // namespace ddem::harness::test
