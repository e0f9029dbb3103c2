// ddem-fem with the integrator that is exact in time: what is left is the error of space, and it is as small as the
// degree promises.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "harness/references/rayleigh_lamb.h"
#include "tests/fem_reference/case_builder.h"
#include "tests/fem_reference/dalembert.h"
#include "tests/fem_reference/program.h"

namespace ddem::fem {
namespace {

using std::numbers::pi;
using test::bar_case;
using test::case_file;
using test::compare;
using test::Difference;
using test::Json;
using test::receiver_places;
using test::ReleasedPulse;
using test::shear_case;
using test::Signals;
using test::SignalsReader;
using test::strip_length;
using test::strip_width;
using test::Workplace;

const double bar_speed = std::sqrt(1e10 / 1700.0), shear_speed = std::sqrt(1e10 / 2.6 / 1700.0);
constexpr double sigma = 3e-4, centre = 3e-3, drive_duration = 3e-6;
constexpr int lamb_half_waves = 8;

double lamb_speed() {
  return bar_speed * references::lamb_s0(pi * lamb_half_waves / strip_length * strip_width, 0.3).phase;
}

double gaussian(double x) {
  return 1e-6 * std::exp(-0.5 * std::pow((x - centre) / sigma, 2));
}

double edge_motion(double t) {
  return t > 0.0 && t < drive_duration ? 1e-6 * std::pow(std::sin(pi * t / drive_duration), 2) : 0.0;
}

Json exact(Json base, const std::string& id, int nx, int ny, int degree) {
  base["id"] = id;
  base["elements"] = {nx, ny};
  base["degree"] = degree;
  base["time"]["integrator"] = "exact";
  base["time"]["step_fraction"] = 1.0;
  base["sample_every"] = 1;
  return base;
}

// Nodes of all meshes of 33 columns and their multiples.
std::vector<double> places_on_nodes() {
  std::vector<double> x;
  for (int k = 2; k <= 26; k += 3) x.push_back(k * strip_length / 33);
  return x;
}

struct Refinement {
  int degree, nx;
  std::string id(int factor) const { return "p" + std::to_string(degree) + " on " + std::to_string(factor * nx); }
};
const Refinement refinements[] = {{1, 264}, {2, 132}, {3, 132}};

// All cases of the tests below in one run of the program.
class Exact : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    place_ = new Workplace;
    place_->write("cases.json", case_file(cases()));
    const auto outcome = place_->run("cases.json -o signals.h5");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
    reader_ = new SignalsReader(*place_ / "signals.h5");
  }
  static void TearDownTestSuite() {
    delete reader_;
    delete place_;
  }

  static Signals signals(const std::string& id) { return reader_->signals(id); }
  static const SignalsReader& reader() { return *reader_; }

 private:
  static std::vector<Json> cases();
  static inline Workplace* place_ = nullptr;
  static inline SignalsReader* reader_ = nullptr;
};

std::vector<Json> Exact::cases() {
  const Json shear = shear_case(""), bar = bar_case("");
  std::vector<Json> all{exact(shear, "shear p4", 66, 8, 4),  exact(bar, "bar p4", 66, 8, 4),
                        exact(shear, "shear p8", 66, 8, 8),  exact(bar, "bar p8", 66, 8, 8),
                        exact(shear, "shear p8 coarse", 33, 4, 8), exact(bar, "bar p8 coarse", 33, 4, 8)};
  all.push_back(exact(shear, "driven", 66, 1, 8));
  all.back()["initial"] = nullptr;
  all.back()["drive"] = {{"wave", "shear"}, {"shape", "sin2"}, {"duration", drive_duration}, {"amplitude", 1e-6}};
  all.push_back(all.back());
  all.back()["id"] = "driven, verlet";
  all.back()["time"] = {{"step_fraction", 0.05}, {"end", 7.5e-6}};
  all.back()["sample_every"] = 20;
  all.push_back(exact(shear, "struck", 66, 1, 8));
  all.back()["initial"]["field"] = "velocity";
  all.push_back(exact(bar, "standing", 33, 4, 8));
  all.back()["poisson_ratio"] = 0.3;
  all.back()["left"] = "fixed_x";
  all.back()["initial"] = {{"wave", "longitudinal"},
                           {"shape", "standing"},
                           {"amplitude", 1e-6},
                           {"half_waves", lamb_half_waves},
                           {"phase_speed", lamb_speed()}};
  all.back()["time"]["end"] = 2e-5;
  Json points = Json::array();
  for (const double x : places_on_nodes()) points.push_back({x, 0.5 * strip_width});
  for (const Refinement& r : refinements) {
    for (const int factor : {1, 2}) {
      all.push_back(exact(shear, r.id(factor), factor * r.nx, 2, r.degree));
      all.back()["receivers"] = {{"points", points}, {"sections", Json::array()}};
    }
  }
  return all;
}

TEST_F(Exact, PulsesConvergeAtTheNodesWithTwiceTheDegree) {
  for (const Refinement& r : refinements) {
    const auto error = [&](int factor) {
      return compare(signals(r.id(factor)), places_on_nodes(), 1, ReleasedPulse{gaussian, strip_length, 1}, shear_speed).relative_l2;
    };
    // The dispersion of the elements, of order 2p. At higher degrees the interpolated start, whose error stays where it
    // is, shows first; their frequencies are measured one by one (ShearMode).
    EXPECT_NEAR(std::log2(error(1) / error(2)), 2.0 * r.degree, 0.2) << error(1) << " " << error(2);
  }
}

struct Figure {
  const char *shear, *bar;
  double error, speed_error;
};

TEST_F(Exact, PulsesMeetDAlembertToTheDegreesAccuracy) {
  // Ten receivers between 1 and 12.7 mm, none on a node by design, 7.5 us, all samples. Measured: 1.4e-5 (bar 1.9e-5),
  // 8.4e-8 (9.2e-8), 5.0e-11 (5.4e-11); speeds 6e-8, 4e-11, 3e-14.
  for (const Figure& f : {Figure{"shear p4", "bar p4", 3e-5, 3e-6}, Figure{"shear p8 coarse", "bar p8 coarse", 2e-7, 1e-8},
                          Figure{"shear p8", "bar p8", 1e-10, 1e-11}}) {
    // The bar's pulse comes back from the fixed end, upside down.
    const Difference shear = compare(signals(f.shear), receiver_places(), 1, ReleasedPulse{gaussian, strip_length, 1}, shear_speed);
    const Difference bar = compare(signals(f.bar), receiver_places(), 0, ReleasedPulse{gaussian, strip_length, -1}, bar_speed);
    EXPECT_LT(shear.relative_l2, f.error) << f.shear;
    EXPECT_LT(bar.relative_l2, f.error) << f.bar;
    EXPECT_LT(std::abs(shear.speed), f.speed_error) << f.shear;
    EXPECT_LT(std::abs(bar.speed), f.speed_error) << f.bar;
  }
}

TEST_F(Exact, StandingLambWaveHasItsPhaseSpeed) {
  // A point moves as cos(w t) alone if field and frequency are those of a mode. Least squares for w: with a residual r
  // the step is sum r t sin/sum t^2 sin^2.
  const Signals s = signals("standing");
  const double w = pi * lamb_half_waves / strip_length * lamb_speed();
  double residual2 = 0.0, total2 = 0.0, slope_residual = 0.0, slope2 = 0.0, shift = 0.0;
  for (std::size_t k = 0; k < s.point_count; ++k) {
    for (std::size_t n = 0; n < s.time.size(); ++n) {
      const double start = s.point(0, k, 0), u = s.point(n, k, 0), phase = w * s.time[n];
      const double residual = u - start * std::cos(phase), slope = -start * phase * std::sin(phase);
      residual2 += residual * residual;
      total2 += u * u;
      slope_residual += slope * residual;
      slope2 += slope * slope;
    }
  }
  shift = slope_residual / slope2;
  EXPECT_GT(w * s.time.back(), 2.0 * pi * 10.0);  // ten periods
  EXPECT_LT(std::abs(shift), 1e-10);
  // The field between the nodes, interpolated over an element of 1/2 mm: the wave is 4.1 mm long. Measured 5e-13.
  EXPECT_LT(std::sqrt(residual2 / total2), 1e-11);
}

TEST_F(Exact, StruckStripIsDAlembert) {
  // Velocity f at rest: u = (1/2c) int_(x-ct)^(x+ct) f; the receivers see no echo from the free right end before the
  // pulse returns, and the left end reflects it unchanged: f is even about both.
  const auto integral = [](double x) {  // from the centre
    return 1e-6 * sigma * std::sqrt(0.5 * pi) * std::erf((x - centre) / (sigma * std::sqrt(2.0)));
  };
  const auto mirrored = [&](double x) {
    const double whole = integral(strip_length) - integral(0.0);
    if (x < 0.0) return 2.0 * integral(0.0) - integral(-x);
    return x > strip_length ? integral(0.0) + 2.0 * whole - (integral(2.0 * strip_length - x) - integral(0.0)) : integral(x);
  };
  const auto solution = [&](double x, double t, double c) {
    return 0.5 * (mirrored(x + c * t) - mirrored(x - c * t)) / c;
  };
  const Difference d = compare(signals("struck"), receiver_places(), 1, solution, shear_speed);
  EXPECT_LT(d.relative_l2, 1e-11);  // measured 1e-12
}

TEST_F(Exact, DrivenEdgeIsDAlembertAndTheLimitOfSmallSteps) {
  const auto solution = [&](double x, double t, double speed) {
    return edge_motion(t - x / speed) + edge_motion(t - (2.0 * strip_length - x) / speed);
  };
  // The curvature of sin^2 jumps at its ends: its wave has a spectrum ~ w^-3 that no mesh resolves.
  const Difference wave = compare(signals("driven"), receiver_places(), 1, solution, shear_speed);
  EXPECT_LT(wave.relative_l2, 3e-5);  // measured 1.6e-5
  EXPECT_LT(std::abs(wave.speed), 1e-7);
  // The same equations marched with a twentieth of the critical step. A wave of frequency w runs ahead by
  // (w dt)^2/24: for this pulse's w = 2 pi/3 us, 2e-10 s and 12 rad of phase a few 1e-7; its highest frequencies,
  // (w dt)^2/24 of 4e-4 over 12/0.0035 rad, are lost where they have 1e-5 of the amplitude.
  const Signals fine = signals("driven, verlet"), sharp = signals("driven");
  ASSERT_LE(fine.time.size(), sharp.time.size() + 1);
  double difference = 0.0;
  for (std::size_t n = 0; n < std::min(fine.time.size(), sharp.time.size()); ++n) {
    ASSERT_NEAR(fine.time[n], sharp.time[n], 1e-18);
    for (std::size_t k = 0; k < fine.point_count; ++k) {
      difference = std::max(difference, std::abs(fine.point(n, k, 1) - sharp.point(n, k, 1)));
    }
  }
  EXPECT_LT(difference, 3e-5 * 1e-6);
}

TEST_F(Exact, MarchesWithTheLargestStepAndKeepsItsInvariant) {
  for (const char* id : {"shear p4", "bar p8", "standing", "driven", "struck"}) {
    EXPECT_LT(reader().number(id, "energy_drift"), 1e-12) << id;
    EXPECT_NEAR(reader().number(id, "time_step"), 0.99 * reader().number(id, "critical_time_step"), 1e-22) << id;
    EXPECT_NEAR(reader().number(id, "sample_interval"), reader().number(id, "critical_time_step"), 1e-22) << id;
  }
  const double steps = reader().number("bar p8", "steps");
  const double needed = 7.5e-6 / reader().number("bar p8", "time_step");
  EXPECT_LT(steps, needed + 8.0 * std::cbrt(2.0 * needed) + 10.0);
}

}  // namespace
}  // namespace ddem::fem
