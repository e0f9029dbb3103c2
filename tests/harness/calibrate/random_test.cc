// The strip of 682 random discs: what is fitted on some packings must hold on others, at rest and in motion.
#include <cmath>

#include "harness/calibrate/proof.h"
#include "tests/harness/calibrate/scenes.h"

namespace ddem::harness::test {
namespace {

const auto kNothing = [] {};

double mean_of(const Proof& p, double ProofSeed::*member) {
  double sum = 0.0;
  for (const ProofSeed& s : p.seeds) sum += s.*member;
  return sum / static_cast<double>(p.seeds.size());
}

/// What a user is promised for k_t/k_n >= 0.1: static residual 1e-6 on the fitted seeds, on eight others mean
/// nu within 0.01 and E within 2 % (three standard errors of six fitted and eight unseen packings that
/// scatter by 0.005 and 2 % are 0.008 and 3 %), driven shear and P pulses within 0.5 % of the static speeds
/// of their own strips, on average.
void expect_kept(const Scene& scene, const Calibration& c) {
  ASSERT_TRUE(c.feasible);
  EXPECT_GE(c.found.point.stiffness_ratio, 0.1);
  EXPECT_LT(std::abs(c.young_residual()), 1e-6);
  EXPECT_LT(std::abs(c.poisson_residual()), 1e-6);
  ASSERT_EQ(c.seeds.size(), 6u);
  const Proof proof = prove(scene, c.found, 7, 8, 2, kNothing);
  ASSERT_EQ(proof.seeds.size(), 8u);
  EXPECT_TRUE(proof.unseen);
  EXPECT_NEAR(mean_of(proof, &ProofSeed::poisson_ratio), c.target.poisson_ratio, 0.01);
  EXPECT_NEAR(mean_of(proof, &ProofSeed::young_modulus) / c.target.young_modulus, 1.0, 0.02);
  for (const auto wave : {&ProofSeed::shear, &ProofSeed::p}) {
    const auto deviation = dynamic_deviation(proof, wave, &ProofWave::peak);
    ASSERT_TRUE(deviation);
    EXPECT_EQ(deviation->count, 8);
    EXPECT_LT(std::abs(deviation->mean), 0.005);
  }
  // The free strip of nine discs is softer than its bulk, by 1 to 13 % (theory section 4).
  const auto bias = bar_bias(proof);
  ASSERT_TRUE(bias);
  EXPECT_LT(bias->mean, -0.01);
  EXPECT_GT(bias->mean, -0.13);
}

TEST(RandomCalibration, RigidDiscs) {
  const Scene scene = strip_scene();
  const Calibration c = calibrate(scene, target_of(30e9, 0.25), {{}, 6, 2});
  EXPECT_FALSE(c.stability);
  expect_kept(scene, c);
}

/// Beyond what rigid discs reach at this coordination (1/3 and a little more), with k_t/k_n = 0.2.
TEST(RandomCalibration, AHighPoissonsRatioByImplicitStrains) {
  const Scene scene = strip_scene("implicit", "full");
  const CalibrationOptions options{held(0.2, {}, {}), 6, 2};
  const Calibration c = calibrate(scene, target_of(30e9, 0.42), options);
  EXPECT_EQ(c.found.point.stiffness_ratio, 0.2);
  EXPECT_LT(c.ranges.front().poisson.highest, 0.40);
  expect_kept(scene, c);
}

TEST(RandomCalibration, SaysWhatWouldHelp) {
  const Calibration c = calibrate(strip_scene(), target_of(30e9, 0.42), {{}, 2, 2});
  EXPECT_FALSE(c.feasible);
  EXPECT_NEAR(c.poisson_ratio, c.ranges.front().poisson.highest, 1e-9);
  std::string all;
  for (const std::string& s : c.what_helps) all += s + "\n";
  EXPECT_NE(all.find("implicit F"), std::string::npos);
  EXPECT_NE(all.find("coordination = "), std::string::npos);
}

/// The same bits for any number of threads.
TEST(RandomCalibration, DoesNotDependOnThreads) {
  const Scene scene = strip_scene();
  const Calibration one = calibrate(scene, target_of(30e9, 0.2), {{}, 3, 1}),
                    three = calibrate(scene, target_of(30e9, 0.2), {{}, 3, 3});
  EXPECT_EQ(one.found.stiffness, three.found.stiffness);
  EXPECT_EQ(one.found.point, three.found.point);
}

/// A hexagonal cell has neither seeds nor ends.
TEST(LatticeProof, SaysWhyThereAreNoWaves) {
  const Scene scene = lattice_scene();
  const Calibration c = calibrate(scene, target_of(30e9, 0.25), {});
  const Proof proof = prove(scene, c.found, 0, 8, 1, kNothing);
  ASSERT_EQ(proof.seeds.size(), 1u);
  EXPECT_FALSE(proof.unseen);
  EXPECT_FALSE(proof.no_waves.empty());
  EXPECT_FALSE(dynamic_deviation(proof, &ProofSeed::p, &ProofWave::peak));
  EXPECT_FALSE(bar_bias(proof));
  EXPECT_NEAR(proof.seeds[0].poisson_ratio, 0.25, 1e-9);
}

}  // namespace
}  // namespace ddem::harness::test
