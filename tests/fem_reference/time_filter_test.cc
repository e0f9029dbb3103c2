// Exactness in time: the coefficients against closed forms in the frequency, and the filtered states of a leapfrog
// against the eigenvectors of a small strip.


#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "dem/core/time_filter.h"
#include "fem_reference/kernel/critical_step.h"
#include "fem_reference/kernel/leapfrog.h"
#include "tests/fem_reference/dense.h"
#include "tests/fem_reference/rectangle_mesh.h"

namespace ddem::fem {
namespace {

using std::numbers::pi;

constexpr Sin2 drive{80.0};

// int_0^t sin(w (t - s))/w (1 - cos(W s))/2 ds, with no difference of nearly equal terms at w = W or w = 0.
double cosine_drive(double w, double t) {
  if (t <= 0.0) return 0.0;
  const double W = 2.0 * pi / drive.duration, d = 0.5 * (w - W) * t;
  const double constant = w == 0.0 ? 0.5 * t * t : 2.0 * std::pow(std::sin(0.5 * w * t) / w, 2);
  const double sinc = std::abs(d) < 1e-8 ? 1.0 : std::sin(d) / d;
  return 0.5 * (constant - std::sin(0.5 * (w + W) * t) * t * sinc / (w + W));
}

double released(double w, double t) {
  return std::cos(w * t);
}

double struck(double w, double t) {
  return w == 0.0 ? t : std::sin(w * t) / w;
}

double driven(double w, double t) {
  return cosine_drive(w, t) - cosine_drive(w, t - drive.duration);
}

struct Response {
  const char* name;
  void (*coefficients)(std::span<const double>, double, std::span<double>);
  double (*exact)(double w, double t);
  double (*size)(double t);
};

void driven_coefficients(std::span<const double> t, double dt, std::span<double> a) {
  drive_coefficients(drive, t, dt, a);
}

const Response responses[] = {
    {"released", release_coefficients, released, [](double) { return 1.0; }},
    {"struck", impulse_coefficients, struck, [](double t) { return t; }},
    {"driven", driven_coefficients, driven, [](double t) { return t * std::min(t, drive.duration); }}};

class TimeFilter : public testing::TestWithParam<Response> {};
INSTANTIATE_TEST_SUITE_P(Responses, TimeFilter, testing::ValuesIn(responses),
                         [](const auto& p) { return p.param.name; });

TEST_P(TimeFilter, IsTheClosedFormAtEveryFrequency) {
  // Step 1: frequencies 2 sin(psi), states cos(2 k psi). Each of the z coefficients carries round-off: with z = 2000
  // and 1e-16 of their sum, which is of order sqrt(z), a few 1e-14; 20 times that.
  for (const double t : {0.0, 1e-12, 1e-5, 0.3, 7.0, 40.0, 80.0, 81.0, 160.0, 1000.0}) {
    std::vector<double> a(states_for(t, 1.0));
    GetParam().coefficients({&t, 1}, 1.0, a);
    for (int n = 0; n <= 100; ++n) {
      const double psi = 0.5 * pi * n / 100.0, w = 2.0 * std::sin(psi);
      double sum = 0.0;
      for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * std::cos(2.0 * static_cast<double>(k) * psi);
      ASSERT_NEAR(sum, GetParam().exact(w, t), 1e-12 * GetParam().size(t)) << "t " << t << " w " << w;
    }
  }
}

/// Samples that are neighbours, or far apart, before and after the drive's end: bit by bit as each alone.
TEST_P(TimeFilter, OfManyTimesIsThatOfEach) {
  const std::vector<double> times{0.0, 3e-11, 1e-5, 0.7, 1.4, 79.9, 80.0, 80.1, 2.0, 300.0, 301.0};
  const std::size_t count = states_for(301.0, 1.0);
  std::vector<double> all(count * times.size()), one(count);
  GetParam().coefficients(times, 1.0, all);
  for (std::size_t m = 0; m < times.size(); ++m) {
    GetParam().coefficients({&times[m], 1}, 1.0, one);
    for (std::size_t k = 0; k < count; ++k) ASSERT_EQ(all[k * times.size() + m], one[k]) << times[m] << " " << k;
  }
}

TEST_P(TimeFilter, IsExactForTheStatesOfALeapfrogAtAnyStep) {
  const auto mesh = test::make_rectangle({.length = 0.3, .height = 0.2, .nx = 3, .ny = 2, .degree = 3, .slant = 0.2});
  const ElasticOperator stiffness(mesh.mesh, plane_material(1.0, 0.3, 1.0, Plane::stress));
  auto inverse_mass = test::free_inverse_mass(stiffness);
  inverse_mass[3] = inverse_mass[8] = 0.0;
  const auto modes = test::modes(stiffness, inverse_mass);
  auto start = test::interpolate(
      mesh, [](double x, double y) { return std::sin(9.0 * x) + y; }, [](double x, double y) { return x * y; });
  start[3] = start[8] = 0.0;
  const double critical = critical_time_step(stiffness, inverse_mass);
  for (const double fraction : {0.99, 0.37}) {
    // In units where the step is 1, so that the drive's duration of 80 means something.
    const double dt = fraction * critical, t = 97.3;
    std::vector<double> a(states_for(t, 1.0)), sum(start.size(), 0.0);
    GetParam().coefficients({&t, 1}, 1.0, a);
    Leapfrog leapfrog(stiffness, inverse_mass, {start, {}}, dt);
    for (std::size_t k = 0; k < a.size(); ++k) {
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += a[k] * leapfrog.displacement()[i];
      leapfrog.step();
    }
    const auto exact = modes.apply([&](double w) { return GetParam().exact(w * dt, t); }, start);
    double size = 0.0, error = 0.0;
    for (std::size_t i = 0; i < sum.size(); ++i) {
      size = std::max(size, std::abs(exact[i]));
      error = std::max(error, std::abs(sum[i] - exact[i]));
    }
    EXPECT_LT(error, 1e-11 * size) << fraction;  // the eigenvectors' round-off times the condition of K, 1e4
  }
}

TEST(TimeFilterLimits, StatesAreAFewMoreThanTheSteps) {
  EXPECT_EQ(states_for(0.0, 1.0), 1u);
  for (const double steps : {10.0, 1e3, 1e5}) {
    EXPECT_GT(static_cast<double>(states_for(steps, 1.0)), steps);
    EXPECT_LT(static_cast<double>(states_for(steps, 1.0)), steps + 8.0 * std::cbrt(2.0 * steps) + 10.0);
  }
}

TEST(TimeFilterLimits, RefusesAPulseThatTheStepDoesNotResolve) {
  std::vector<double> a(10);
  const double time = 1.0;
  EXPECT_THROW(drive_coefficients(drive, {&time, 1}, 1.1 * largest_step_for(drive), a), std::invalid_argument);
  drive_coefficients(drive, {&time, 1}, largest_step_for(drive), a);
}

TEST(TimeFilterLimits, PulseIsRaisedAndAtRestOutside) {
  EXPECT_EQ(drive(-1.0), 0.0);
  EXPECT_EQ(drive(80.0), 0.0);
  EXPECT_EQ(drive(1e9), 0.0);
  EXPECT_DOUBLE_EQ(drive(40.0), 1.0);
  EXPECT_NEAR(drive(20.0), 0.5, 1e-15);
}

}  // namespace
}  // namespace ddem::fem
