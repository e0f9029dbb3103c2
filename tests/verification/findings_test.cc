// The sentences at the top of the report, from results that are known.
#include <gtest/gtest.h>

#include <cmath>

#include "harness/studies/finite_elements/finite_elements_verdicts.h"
#include "harness/studies/schemes/schemes_verdicts.h"
#include "harness/studies/waves/waves_findings.h"

namespace ddem::harness {
namespace {

/// P at 2000 m/s; the shear wave is that of Poisson's ratio `nu` (1 - 2 (c_s/c_p)^2).
void add_waves(StripResults& r, StripPacking packing, std::int64_t seed, Model model, double ratio, double nu, double seconds, double off) {
  for (const StripWave wave : {StripWave::p, StripWave::shear}) {
    WaveOutcome w;
    w.c = {packing, seed, model, ratio, Protocol::long_wave, wave};
    w.speed = wave == StripWave::p ? 2000.0 : 2000.0 * std::sqrt(0.5 * (1.0 - nu));
    w.section_speed = packing == StripPacking::random ? *w.speed / (1.0 + off) : 0.0;
    w.kinematic_speed = *w.speed / (1.0 - off);
    w.seconds = seconds;
    r.waves.push_back(w);
  }
}

StripResults two_models(double ddem) {
  StripResults r;
  r.campaign.models = {Model::dem, Model::implicit_full};
  r.campaign.seeds = {1, 2};
  r.campaign.stiffness_ratios = {0.0, 1.0};
  for (const std::int64_t seed : r.campaign.seeds) {
    add_waves(r, StripPacking::random, seed, Model::dem, 0.0, 0.3, 1.0, 0.001);
    add_waves(r, StripPacking::random, seed, Model::dem, 1.0, 0.05, 1.0, 0.001);
    add_waves(r, StripPacking::random, seed, Model::implicit_full, 0.0, ddem, 3.0, 0.001);
    add_waves(r, StripPacking::random, seed, Model::implicit_full, 1.0, 0.2, 3.0, seed == 2 ? 0.004 : 0.001);
  }
  add_waves(r, StripPacking::hexagonal, 0, Model::dem, 0.0, 0.3, 1.0, 0.002);
  for (const double slow : {0.01, 0.02}) {
    WaveOutcome bar;
    bar.c = {StripPacking::random, 1, Model::dem, 0.5, Protocol::long_wave, StripWave::bar};
    bar.speed = 1000.0 * (1.0 - slow), bar.static_speed = 1000.0, bar.seconds = 1.0;
    if (slow == 0.02) bar.s0.peak = *bar.speed / 1.005;
    r.waves.push_back(bar);
  }
  return r;
}

TEST(WaveFindings, SayWhatWasFound) {
  EXPECT_EQ(wave_findings(two_models(0.42)),
            (std::vector<std::string>{
                "In random packings DDEM F implicit reaches Poisson's ratios from 0.200 to 0.420, DEM from 0.050 to 0.300: 0.120 beyond it. Its waves cost "
                "3.0 times the computing time of DEM's.",
                "P and shear waves through random packings run within 0.40 % (median 0.10 %, waves: 16) of the static speeds between the same sections.",
                "Bar waves through random packings run within 2.00 % (median 1.50 %, waves: 2) of the static speeds of their strips, and within 0.50 % (median "
                "0.50 %, waves: 1) of what the dispersion of S0 makes of these.",
                "P and shear waves through the lattice run within 0.20 % (median 0.20 %, waves: 2) of the closed forms."}));
  EXPECT_NE(wave_findings(two_models(0.25)).front().find("DEM from 0.050 to 0.300: no more."), std::string::npos);
}

TEST(WaveFindings, AreNoneOfWhatWasNotMeasured) {
  StripResults r = two_models(0.42);
  for (WaveOutcome& w : r.waves) w.speed.reset();
  EXPECT_TRUE(wave_findings(r).empty());
  EXPECT_TRUE(wave_findings({}).empty());
}

TEST(ContinuumFinding, IsTheWorstOfThePlaneWaves) {
  StripResults r;
  EXPECT_EQ(continuum_finding(r), "");
  const auto add = [&r](StripWave wave, std::optional<double> speed) {
    FemOutcome f;
    f.wave = wave, f.speed = speed, f.analytical_speed = 2000.0;
    r.fem.push_back(f);
  };
  add(StripWave::bar, 1900.0);
  add(StripWave::shear, std::nullopt);
  EXPECT_EQ(continuum_finding(r), "");
  add(StripWave::shear, 1999.0);
  add(StripWave::p, 2000.5);
  EXPECT_EQ(continuum_finding(r), "Finite elements with the static moduli of the packings meet the continuum's P and shear speeds within 0.05 % (runs: 2).");
}

TEST(ReachFinding, IsTheHighestOfEachScheme) {
  SchemeStudy study;
  EXPECT_EQ(reach_finding(study), "");
  study.reach_poisson_ratio = 0.49;
  study.reach = {{"implicit", {{0.1, 0.35, 0.0}, {10.0, 0.48, 0.0}}}, {"lagged", {{0.4, 0.386, 0.0}, {1.5, std::nullopt, 0.0}}}, {"none", {{0.4, std::nullopt, 0.0}}}};
  EXPECT_EQ(reach_finding(study),
            "The lattice of νₚ = 0.49 without tangential stiffness reaches Poisson's ratios of 1/3 with rigid discs, with softer ones by scheme: implicit 0.480 "
            "(kₙ/Eₚ = 10); lagged 0.386 (kₙ/Eₚ = 0.4).");
}

}  // namespace
}  // namespace ddem::harness
