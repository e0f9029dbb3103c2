// A pulse that starts without its lateral contraction (nu not 0, free edges): the free edges are loaded at once and send
// waves with kinks through the strip, which no degree resolves at a point.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "harness/references/rayleigh_lamb.h"
#include "tests/fem_reference/case_builder.h"
#include "tests/fem_reference/program.h"
#include "tests/fem_reference/strip_modes.h"

namespace ddem::fem {
namespace {

using std::numbers::pi;
using test::Json;
using test::Signals;
using test::strip_length;
using test::StripModes;
using test::strip_width;

constexpr double sigma = 3e-4, centre = 3e-3, end = 7.5e-6;
constexpr int cross_elements = 8;  // of the reference, over half the width: twice those of the finer mesh
const PlaneMaterial material = plane_material(1e10, 0.3, 1700.0, Plane::stress);

double height(double x) { return 0.1 * x; }

struct Reference {
  std::vector<std::vector<double>> points, sections;  ///< [receiver][sample], u_x
};

// Between ends that are fixed in x the pulse is the sum of the waves sin(n pi x/L).
Reference reference(const std::vector<double>& time) {
  const auto places = test::receiver_places();
  const std::vector<double> nothing(time.size(), 0.0);
  Reference u{std::vector(places.size(), nothing), std::vector(places.size(), nothing)};
  // exp(-6^2/2) is 1.5e-8.
  for (int n = 1; n * pi / strip_length * sigma < 6.0; ++n) {
    const double k = n * pi / strip_length;
    const StripModes modes(material, strip_width, k, cross_elements);
    const double share = 2.0 / strip_length * 1e-6 * sigma * std::sqrt(2.0 * pi) * std::exp(-0.5 * std::pow(k * sigma, 2)) *
                         std::sin(k * centre);
    Eigen::MatrixXd motion(modes.frequency().size(), static_cast<Eigen::Index>(time.size()));
    for (std::size_t t = 0; t < time.size(); ++t) motion.col(t) = (modes.frequency() * time[t]).array().cos();
    for (std::size_t r = 0; r < places.size(); ++r) {
      const double wave = share * std::sin(k * places[r]);
      const Eigen::RowVectorXd point = wave * modes.at(height(places[r]) - 0.5 * strip_width).transpose() * motion;
      const Eigen::RowVectorXd section = wave * modes.mean().transpose() * motion;
      for (std::size_t t = 0; t < time.size(); ++t) u.points[r][t] += point[t], u.sections[r][t] += section[t];
    }
  }
  return u;
}

double relative_l2(const std::vector<std::vector<double>>& exact, const std::function<double(std::size_t, std::size_t)>& value) {
  double residual2 = 0.0, total2 = 0.0;
  for (std::size_t r = 0; r < exact.size(); ++r) {
    for (std::size_t t = 0; t < exact[r].size(); ++t) {
      residual2 += std::pow(value(t, r) - exact[r][t], 2);
      total2 += exact[r][t] * exact[r][t];
    }
  }
  return std::sqrt(residual2 / total2);
}

TEST(FreeEdge, TheReferenceHoldsRayleighAndLambsWave) {
  for (const double k_width : {0.1, 1.0, 6.0}) {
    const double k = k_width / strip_width, bar_speed = std::sqrt(1e10 / 1700.0);
    const double expected = k * bar_speed * references::lamb_s0(k_width, 0.3).phase;
    EXPECT_NEAR(StripModes(material, strip_width, k, 4).lowest_frequency() / expected, 1.0, 1e-9);
  }
}

TEST(FreeEdge, UniformPulseWithContraction) {
  const test::Workplace place;
  std::vector<Json> cases;
  for (const int factor : {1, 2}) {
    Json bar = test::bar_case(factor == 1 ? "coarse" : "fine");
    bar["poisson_ratio"] = 0.3;
    bar["elements"] = {33 * factor, 4 * factor};
    bar["degree"] = 8;
    bar["left"] = "fixed_x";
    bar["time"] = {{"integrator", "exact"}, {"step", end / 150.0}, {"end", end}};
    bar["sample_every"] = 1;
    cases.push_back(bar);
  }
  place.write("cases.json", test::case_file(cases));
  const auto outcome = place.run("cases.json -o signals.h5");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  const test::SignalsReader reader(place / "signals.h5");
  const Signals coarse = reader.signals("coarse"), fine = reader.signals("fine");
  const Reference exact = reference(fine.time);
  const auto points = [&](const Signals& s) {
    return relative_l2(exact.points, [&](std::size_t t, std::size_t r) { return s.point(t, r, 0); });
  };
  const auto sections = [&](const Signals& s) {
    return relative_l2(exact.sections, [&](std::size_t t, std::size_t r) { return s.section(t, r, 0); });
  };
  // At points of displacement with kinks polynomials converge between h^1.5 and h^2. Measured: 8.7e-4, order 1.7.
  EXPECT_LT(points(fine), 1e-3);
  EXPECT_NEAR(std::log2(points(coarse) / points(fine)), 1.75, 0.35) << points(coarse) << " " << points(fine);
  // The mean over the height sees the kinks of the mean alone, which are weaker. Measured: 1.4e-6, order 3.8.
  EXPECT_LT(sections(fine), 3e-6);
  EXPECT_NEAR(std::log2(sections(coarse) / sections(fine)), 4.0, 0.5) << sections(coarse) << " " << sections(fine);
}

}  // namespace
}  // namespace ddem::fem
