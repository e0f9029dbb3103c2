// Cases that are one problem in other units: found, and their rescaled results those of runs of their own.

#include "harness/run/fem_reuse.h"

#include <gtest/gtest.h>

#include <cmath>

#include "harness/io/errors.h"

namespace ddem::harness {
namespace {

FemCase wave_case(Wave wave, bool periodic, ContinuumMaterial material, double amplitude = 1e-6) {
  FemCase c;
  c.id = "a/name that is no group";
  c.length = 16.5e-3;
  c.width = 2e-3;
  c.elements = {16, 2};
  c.material = material;
  c.periodic = periodic;
  const double speed = material.wave_speed(wave, periodic);
  c.load = Drive{wave, DriveShape::sin2, 8e-3 / speed, amplitude};
  c.step = StepSeconds{1e-4 / speed};
  c.end = 15e-3 / speed;
  c.points = {{5e-3, 1e-3}, {9e-3, 4e-4}};
  c.sections = {8e-3};
  return c;
}

constexpr ContinuumMaterial kSteel{2e11, 0.3, 7800.0}, kGlass{7e10, 0.2, 2500.0}, kOther{5e9, 0.3, 1234.0};

TEST(FemReuse, OneRunForAllMaterialsWhereTheWaveIsPlane) {
  for (const Wave wave : {Wave::shear, Wave::longitudinal}) {
    const std::vector<FemCase> cases{wave_case(wave, true, kSteel), wave_case(wave, true, kGlass, -2e-9), wave_case(wave, true, kOther)};
    EXPECT_EQ(share_runs(cases).runs.size(), 1u);
  }
  const std::vector<FemCase> bars{wave_case(Wave::longitudinal, false, kSteel), wave_case(Wave::longitudinal, false, kGlass),
                                  wave_case(Wave::longitudinal, false, kOther)};
  const FemReuse reuse = share_runs(bars);
  EXPECT_EQ(reuse.runs.size(), 2u);  // by Poisson's ratio
  EXPECT_EQ(reuse.shares[2].run, 0u);
}

TEST(FemReuse, WhatDiffersIsRunAgain) {
  const FemCase base = wave_case(Wave::shear, true, kSteel);
  std::vector<FemCase> cases(8, base);
  cases[1].width *= 1.001;
  cases[2].elements = {17, 2};
  cases[3].degree = 5;
  cases[4].right = Edge::free;
  cases[5].points[0][0] += 1e-5;
  std::get<Drive>(cases[6].load).duration *= 1.001;
  cases[7].integrator = Integrator::verlet;
  EXPECT_EQ(share_runs(cases).runs.size(), cases.size());
  // The step of a leapfrog run follows from Poisson's ratio.
  FemCase steel = wave_case(Wave::shear, true, kSteel), glass = wave_case(Wave::shear, true, kGlass);
  steel.integrator = glass.integrator = Integrator::verlet;
  EXPECT_EQ(share_runs(std::vector{steel, glass}).runs.size(), 2u);
}

TEST(FemReuse, RunsAsLongAsTheLongestNeeds) {
  FemCase longer = wave_case(Wave::shear, true, kGlass);
  longer.end *= 1.5;
  const FemReuse reuse = share_runs(std::vector{wave_case(Wave::shear, true, kSteel), longer});
  ASSERT_EQ(reuse.runs.size(), 1u);
  EXPECT_NEAR(reuse.runs[0].end * kSteel.wave_speed(Wave::shear, true), 22.5e-3, 1e-15);
}

double largest_difference(const FemResult& a, const FemResult& b) {
  double difference = 0.0;
  const auto compare = [&](const auto& one, const auto& other) {
    ASSERT_EQ(one.size(), other.size());
    for (std::size_t k = 0; k < one.size(); ++k) {
      ASSERT_EQ(one[k].size(), other[k].size());
      for (std::size_t n = 0; n < one[k].size(); ++n) difference = std::max(difference, std::abs(one[k][n] - other[k][n]));
    }
  };
  compare(a.point_ux, b.point_ux);
  compare(a.point_uy, b.point_uy);
  compare(a.section_ux, b.section_ux);
  compare(a.section_uy, b.section_uy);
  return difference;
}

TEST(FemReuse, RescaledResultsAreThoseOfTheirOwnRuns) {
  std::vector<FemCase> cases{wave_case(Wave::shear, true, kSteel),         wave_case(Wave::shear, true, kGlass, -2e-9),
                             wave_case(Wave::longitudinal, true, kGlass),  wave_case(Wave::longitudinal, true, kSteel, 3e-6),
                             wave_case(Wave::longitudinal, false, kSteel), wave_case(Wave::longitudinal, false, kOther, 1e-8)};
  cases[0].end *= 1.2;
  std::size_t heard = 0;
  std::vector<FemResult> together;
  try {
    together = run_fem(cases, [&] { ++heard; });
  } catch (const MachineError& e) {
    GTEST_SKIP() << e.what();  // built without deal.II
  }
  EXPECT_EQ(heard, cases.size());
  for (const std::size_t k : {1u, 3u, 5u}) {  // rescaled ones; the others are the runs themselves
    const FemResult alone = run_fem(std::span(&cases[k], 1)).front();
    ASSERT_EQ(together[k].time.size(), alone.time.size()) << k;
    EXPECT_NEAR(together[k].time.back(), alone.time.back(), 1e-12 * alone.time.back());
    EXPECT_NEAR(together[k].sample_interval, alone.sample_interval, 1e-12 * alone.sample_interval);
    // Round-off of a drive, 1e-12 of its amplitude (time_filter.h), in either run.
    const double amplitude = std::abs(std::get<Drive>(cases[k].load).amplitude);
    EXPECT_LT(largest_difference(together[k], alone), 1e-11 * amplitude) << k;
    const auto& moving = k < 2 ? alone.point_uy : alone.point_ux;
    const auto [low, high] = std::minmax_element(moving[0].begin(), moving[0].end());
    EXPECT_GT(std::max(-*low, *high), 0.9 * amplitude);
  }
}

}  // namespace
}  // namespace ddem::harness
