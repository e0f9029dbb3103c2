// What a picker must refuse: a doubtful pick is a status with a reason, never a number.

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "harness/measure/picker.h"
#include "synthetic.h"

namespace ddem::harness {
namespace {

using synthetic::gaussian;
using synthetic::Record;
using synthetic::sample;
using synthetic::sin2;
using synthetic::with_noise;

void expect_refused(const Pick& pick, Failure failure) {
  ASSERT_FALSE(pick.ok());
  EXPECT_EQ(name(pick.error().failure), name(failure)) << pick.error().reason;
  EXPECT_FALSE(pick.error().reason.empty());
  EXPECT_THROW(pick.value(), std::logic_error);
}

Record pulse_at(double peak) {
  return sample([=](double t) { return sin2(t, peak, 100.0); }, 500);
}

TEST(PickRefuses, NoiseOnly) {
  // False alarms. 500 samples at six noise levels, the level known to 1/sqrt(2*400): 500 * 1e-9 per trial.
  const Record silence = sample([](double) { return 0.0; }, 900);
  for (unsigned trial = 0; trial < 1000; ++trial)
    expect_refused(pick_peak(with_noise(silence, 1e-3, trial), {400.0, 899.0}), Failure::below_noise);
}

TEST(PickRefuses, NoiseOnlyAgainstAnExpectedAmplitude) {
  const Record silence = with_noise(sample([](double) { return 0.0; }, 900), 1e-3, 7);
  expect_refused(pick_peak(silence, {0.0, 899.0}, {.expected_amplitude = 0.1}), Failure::below_noise);
}

TEST(PickRefuses, PulseOfTheWrongSign) {
  const Record record = with_noise(pulse_at(250.0), 1e-3, 3);
  expect_refused(pick_peak(record, {150.0, 400.0}, {.polarity = Polarity::negative}), Failure::below_noise);
}

TEST(PickRefuses, WithoutAnythingToCompareWith) {
  expect_refused(pick_peak(pulse_at(60.0), {5.0, 400.0}), Failure::no_reference);
  EXPECT_TRUE(pick_peak(pulse_at(60.0), {5.0, 400.0}, {.expected_amplitude = 1.0}).ok());
  EXPECT_TRUE(pick_peak(pulse_at(60.0), {5.0, 400.0}, {.quiet = Window{300.0, 400.0}}).ok());
}

TEST(PickRefuses, TwoEqualPeaks) {
  const auto two = [](double ratio) {
    return sample([=](double t) { return sin2(t, 200.0, 80.0) + ratio * sin2(t, 320.0, 80.0); }, 500);
  };
  expect_refused(pick_peak(two(1.0), {100.0, 400.0}), Failure::ambiguous);
  expect_refused(pick_peak(two(0.97), {100.0, 400.0}), Failure::ambiguous);
  expect_refused(pick_peak(two(1.03), {100.0, 400.0}), Failure::ambiguous);
  EXPECT_TRUE(pick_peak(two(0.9), {100.0, 400.0}).ok());
}

TEST(PickRefuses, PeakAtTheWindowsEdge) {
  const Record record = pulse_at(250.0);
  expect_refused(pick_peak(record, {120.0, 245.0}), Failure::at_edge);
  expect_refused(pick_peak(record, {255.0, 400.0}, {.expected_amplitude = 1.0}), Failure::at_edge);
  expect_refused(pick_peak(record, {100.0, 250.0}), Failure::at_edge);
  EXPECT_TRUE(pick_peak(record, {100.0, 251.0}).ok());
}

TEST(PickRefuses, NonFiniteSignal) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity()}) {
    for (const std::size_t where : {0UL, 250UL, 499UL}) {
      Record record = pulse_at(250.0);
      record.values[where] = bad;
      expect_refused(pick_peak(record, {150.0, 400.0}), Failure::non_finite);
      expect_refused(pick_centroid(record, {150.0, 400.0}, 50.0), Failure::non_finite);
    }
  }
}

TEST(PickRefuses, FlatSignalsAndPlateaus) {
  expect_refused(pick_peak(sample([](double) { return 0.0; }, 500), {100.0, 400.0}), Failure::flat);
  expect_refused(pick_peak(sample([](double) { return 2.5; }, 500), {100.0, 400.0}), Failure::flat);
  const auto box = [](double t) { return t > 200.0 && t < 300.0 ? 1.0 : 0.0; };
  expect_refused(pick_peak(sample(box, 500), {100.0, 400.0}), Failure::flat);
}

TEST(PickRefuses, WindowsWithoutSamples) {
  expect_refused(pick_peak(pulse_at(250.0), {600.0, 700.0}), Failure::empty_window);
  expect_refused(pick_peak(pulse_at(250.0), {-700.0, -600.0}), Failure::empty_window);
  expect_refused(pick_peak(pulse_at(250.0), {250.1, 251.9}), Failure::empty_window);
  expect_refused(pick_peak({{}, 1.0, 0.0}, {0.0, 1.0}), Failure::empty_window);
}

TEST(PickThrows, OnWrongUse) {
  const Record record = pulse_at(250.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(pick_peak({record.values, 0.0, 0.0}, {100.0, 400.0}), std::invalid_argument);
  EXPECT_THROW(pick_peak({record.values, nan, 0.0}, {100.0, 400.0}), std::invalid_argument);
  EXPECT_THROW(pick_peak(record, {400.0, 100.0}), std::invalid_argument);
  EXPECT_THROW(pick_peak(record, {100.0, nan}), std::invalid_argument);
  EXPECT_THROW(pick_peak(record, {100.0, 400.0}, {.top_fraction = 0.0}), std::invalid_argument);
  EXPECT_THROW(pick_peak(record, {100.0, 400.0}, {.signal_to_noise = -1.0}), std::invalid_argument);
  EXPECT_THROW(pick_peak(record, {100.0, 400.0}, {.expected_amplitude = 0.0}), std::invalid_argument);
  EXPECT_THROW(pick_centroid(record, {100.0, 400.0}, 0.0), std::invalid_argument);
}

TEST(PickKeeps, APulseWhoseFlankIsNoisy) {
  // Noise of 4 % makes many samples of the top cross each other: they are one peak, not rivals.
  const Record clean = sample([](double t) { return gaussian(t, 500.0, 60.0); }, 1000);
  for (unsigned trial = 0; trial < 200; ++trial) {
    const Record noisy = with_noise(clean, 0.04, trial);
    const Pick pick = pick_peak(noisy, {280.0, 800.0}, {.quiet = Window{0.0, 250.0}});
    EXPECT_TRUE(pick.ok()) << pick.error().reason;
  }
}

}  // namespace
}  // namespace ddem::harness
