// Ridges of frequency-wavenumber spectra of runs against the exact branches of the lattice.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/simulation/simulation.h"
#include "dem/spectra/bloch.h"
#include "dem/spectra/spectra.h"
#include "harness/measure/fk_spectrum.h"
#include "tests/support/assemblies.h"

namespace ddem::harness {
namespace {

constexpr int kColumns = 128, kRows = 4;
constexpr double kRadius = 1e-4;

struct Case {
  std::string name;
  bool longitudinal;
  double lambda;
  DeformationParameters deformation;
};

class Dispersion : public testing::TestWithParam<Case> {};

const DeformationParameters kImplicit{Scheme::implicit, Correction::full, 4e10, 0.3, Plane::stress};

INSTANTIATE_TEST_SUITE_P(Runs, Dispersion,
                         testing::Values(Case{"dem_p", true, 0.0, {}}, Case{"dem_shear", false, 0.0, {}},
                                         Case{"dem_shear_with_rotation", false, 0.5, {}},
                                         Case{"implicit_p", true, 0.5, kImplicit}, Case{"implicit_shear", false, 0.5, kImplicit}),
                         [](const auto& tested) { return tested.param.name; });

TEST_P(Dispersion, RidgesLieOnTheBranches) {
  // Close-packed rows along y, periodic in y: columns of discs that move alike, released by the first one, whose sharp
  // edge holds waves of all lengths. Free ends reflect them, which adds waves of the same branches.
  const Case& c = GetParam();
  const Assembly a = ddem::test::hexagonal_assembly({.close_packed = packings::CloseRows::along_y, .columns = kColumns, .rows = kRows,
                                                     .radius = kRadius, .periodic_y = true});
  SimulationInput in;
  in.contact = {1e10, c.lambda, Kinematics::linear};
  in.deformation = c.deformation;
  in.time_step = 0.1 * 2.0 / largest_frequency(a, in.contact, {});
  in.steps = 12000;
  in.sample_every = 4;
  auto& released = c.longitudinal ? in.initial.ux : in.initial.uy;
  released.assign(a.size(), 0.0);
  for (int row = 0; row < kRows; ++row) released[row * kColumns] = 1e-9;
  for (int column = 0; column < kColumns; ++column) in.receivers.push_back({{column}});
  const Signals signals = simulate(a, in).signals;

  const double spacing = std::sqrt(3.0) * kRadius, sampled = static_cast<double>(in.sample_every) * in.time_step;
  const auto ridge = main_ridge(fk_spectrum(c.longitudinal ? signals.ux : signals.uy, spacing, sampled));
  const HexagonalBloch bloch({kRadius, ddem::test::kDensity, 1.0, 0.5 * std::numbers::pi}, in.contact, in.deformation);
  // From eight waves over the strip to half of the zone boundary. The step's own dispersion is (omega dt)^2/24, below
  // 1e-3, and a line is found within 0.02 of 2 pi/duration, 3e-4 of the lowest frequency; free ends add lines beside.
  int found = 0;
  for (const RidgePoint& p : ridge) {
    if (p.wavenumber < 7.5 * 2.0 * std::numbers::pi / (kColumns * spacing) || p.wavenumber > 0.501 * std::numbers::pi / spacing) continue;
    // Along a column's normal: shear is the slowest branch, P the one that moves along x.
    const auto branches = bloch.branches({p.wavenumber, 0.0});
    const auto mine = std::find_if(branches.begin(), branches.end(),
                                   [&](const Branch& b) { return !c.longitudinal || std::norm(b.motion[0]) > 0.5; });
    ASSERT_NE(mine, branches.end());
    EXPECT_NEAR(p.frequency / mine->frequency.real(), 1.0, 0.01) << p.wavenumber;
    ++found;
  }
  EXPECT_EQ(found, 25);  // every wavenumber from 8 to 32 over the strip
}

}  // namespace
}  // namespace ddem::harness
