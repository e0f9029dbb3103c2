// Flutter from the growth of noise against the search for the fluttering vibration itself.

#include <gtest/gtest.h>

#include "dem/spectra/flutter.h"
#include "harness/run/noise_run.h"
#include "meshes/packings/random.h"
#include "tests/support/assemblies.h"

namespace ddem::harness {
namespace {

using ddem::test::kNormalStiffness;

ddem::Assembly small_random() {
  const Packing p = packings::random_jammed({.length = 2.6e-3, .width = 2e-3, .discs = 100, .seed = 1});
  return make_assembly(p, bonds_within_gap(p, 0.3 * mean_radius(p)), 1.0, ddem::test::kDensity, RattlerRule::peel);
}

TEST(NoiseFlutter, GrowsAsTheFlutteringVibration) {
  const ddem::Assembly a = small_random();
  const ContactParameters contact{kNormalStiffness, 1.0, Kinematics::linear};
  const DeformationParameters d{Scheme::implicit, Correction::normal, 4.0 * kNormalStiffness, 0.3, Plane::stress};
  const FlutterSearch search = find_flutter(a, contact, d, {});
  const NoiseFlutter noise = flutter_from_noise(a, contact, d, {});
  ASSERT_TRUE(noise.found);
  EXPECT_NEAR(noise.largest_frequency / search.largest_frequency, 1.0, 1e-6);
  // A step's growth over dt exceeds the rate by 1/sqrt(1 - (omega dt/2)^2), up to 15 % for the fastest vibrations, and
  // slower flutter is still in the noise.
  EXPECT_NEAR(noise.growth_rate / search.frequency.value().imag(), 1.0, 0.15);
}

TEST(NoiseFlutter, NotWhereThereIsAnEnergy) {
  const ContactParameters contact{kNormalStiffness, 1.0, Kinematics::linear};
  const DeformationParameters d{Scheme::lagged, Correction::full, 4.0 * kNormalStiffness, 0.3, Plane::stress};
  EXPECT_FALSE(flutter_from_noise(small_random(), contact, d, {}).found);
}

}  // namespace
}  // namespace ddem::harness
