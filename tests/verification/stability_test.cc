// What `ddem stability` predicts of whole scenes, against known values and against runs.

#include "harness/run/scene_stability.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dem/simulation/simulation.h"
#include "dem/spectra/spectra.h"
#include "harness/model/assemble.h"
#include "harness/scene/read_scene.h"
#include "tests/support/oracles.h"

namespace ddem::harness {
namespace {

Scene scene_of(const std::string& text) {
  SceneResult result = parse_scene(text, "scene.toml", test::kOracles, {Purpose::statics});
  for (const Violation& v : result.violations) ADD_FAILURE() << to_string(v);
  return *result;
}

TEST(SceneStability, StepsOfTheOracleStrip) {
  // tests/oracles/README.md: exact largest eigenfrequencies of the constrained strip. The density there is that of
  // m = 2000 pi (d/2)^2.
  for (const auto& [ratio, omega] : {std::pair{"0.0", 23288562.9875396}, {"0.5", 32935392.075242645}}) {
    const SceneStability s = scene_stability(scene_of(std::string(R"(
[assembly]
packing = "file"
file = "hex_strip/discs.csv"
bonds = "hex_strip/bonds.csv"
[material]
density = 2000.0
[contact]
normal_stiffness = 1e10
stiffness_ratio = )") + ratio),
                                             {4e-3});
    EXPECT_NEAR(s.dem_critical_step * omega / 2.0, 1.0, 1e-5);
    EXPECT_EQ(s.critical.step.value(), s.dem_critical_step);
    EXPECT_TRUE(s.instabilities().empty());
  }
}

std::string random_scene(const std::string& deformation) {
  return R"(
[assembly]
packing = "random"
length = "16.5 mm"
width = "2 mm"
discs = 682
periodic = "xy"
[material]
density = 2000.0
[contact]
normal_stiffness = 1e10
stiffness_ratio = 0.25
[time]
step_fraction = 0.5
[deformation]
young_modulus = 4e10
poisson_ratio = 0.3
)" + deformation;
}

/// Amplitude of u_y's component along cos(k x) at frequency omega, over two periods from `begin` (s) on.
double amplitude_at(const ddem::Assembly& a, const Signals& s, double k, double omega, double begin) {
  const double end = begin + 4.0 * std::numbers::pi / omega;
  double cosine = 0.0, sine = 0.0, samples = 0.0;
  for (std::size_t n = 0; n < s.time.size(); ++n) {
    if (s.time[n] < begin || s.time[n] >= end) continue;
    double projection = 0.0;
    for (std::size_t d = 0; d < a.size(); ++d) projection += a.mass[d] * std::cos(k * a.packing.x[d]) * s.uy[d][n];
    cosine += projection * std::cos(omega * s.time[n]);
    sine += projection * std::sin(omega * s.time[n]);
    samples += 1.0;
  }
  return std::hypot(cosine, sine) / samples;
}

/// ln of what is left of a standing shear wave, one wave over the packing, after 20 periods.
double decay(const Scene& scene, const DeformationParameters& deformation, double time_step, double omega) {
  const ddem::Assembly a = build_assembly(scene);
  const double k = 2.0 * std::numbers::pi / a.packing.length, period = 2.0 * std::numbers::pi / omega;
  SimulationInput in;
  in.contact = contact_parameters(scene);
  in.deformation = deformation;
  in.time_step = time_step;
  in.steps = std::lround(24.0 * period / time_step);
  in.sample_every = 20;
  for (const double x : a.packing.x) in.initial.uy.push_back(1e-9 * std::cos(k * x));
  for (int d = 0; d < static_cast<int>(a.size()); ++d) in.receivers.push_back({{d}});
  const Signals signals = simulate(a, in).signals;
  return std::log(amplitude_at(a, signals, k, omega, 22.0 * period) / amplitude_at(a, signals, k, omega, 2.0 * period));
}

TEST(SceneStability, LagDampingOfALongWaveInARandomPacking) {
  for (const char* options : {"correction = \"full\"", "correction = \"normal\"", "correction = \"full\"\nrelaxation = 0.5",
                              "correction = \"full\"\nevaluations = 3", "correction = \"full\"\nevaluations = 2\nrelaxation = 0.5",
                              "correction = \"normal_only_stress\"\nevaluations = 3"}) {
    const Scene scene = scene_of(random_scene(options));
    const ddem::Assembly a = build_assembly(scene);
    const double dt = 0.5 * 2.0 / largest_frequency(a, contact_parameters(scene), {});
    const WaveGrowth wave = static_waves(scene, dt, {a.packing.length}).front();
    ASSERT_EQ(wave.wave, "shear");
    // The packing splits the wave into its two phases, whose beat the implicit run, which damps nothing, shows as well.
    const DeformationParameters lagged = deformation_parameters(scene);
    DeformationParameters implicit = lagged;
    implicit.scheme = Scheme::implicit;
    implicit.evaluations = 1;
    implicit.relaxation = 1.0;
    implicit.tolerance = 1e-8;  // its own error of the stiffness would shift the beat
    const double measured = decay(scene, lagged, dt, wave.frequency) - decay(scene, implicit, dt, wave.frequency);
    const double predicted = 20.0 * std::log1p(wave.growth_per_period(dt));
    // Left out are terms of relative size omega dt (0.016) and of the wave's dispersion over 150 discs, (k r)^2 = 2e-3.
    EXPECT_NEAR(measured / predicted, 1.0, 0.02) << options;
  }
}

}  // namespace
}  // namespace ddem::harness
