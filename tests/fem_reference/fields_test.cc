// Snapshots of ddem-fem: displacement, velocity, strain and stress of all nodes against closed forms, and the mesh that shows them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "tests/fem_reference/case_builder.h"
#include "tests/fem_reference/dalembert.h"
#include "tests/fem_reference/program.h"

namespace ddem::fem {
namespace {

using std::numbers::pi;
using test::case_file;
using test::Json;
using test::ReleasedPulse;
using test::shear_case;
using test::SignalsReader;
using test::strip_length;
using test::strip_width;
using test::Workplace;

constexpr double pulse_width = 3e-4;
constexpr double receiver_x = 57 * strip_length / 66;  // a corner of elements, in the pulse at the last snapshot
const double shear_speed = std::sqrt(1e10 / 2.6 / 1700.0);

double gaussian(double x) {
  return 1e-6 * std::exp(-0.5 * std::pow((x - 3e-3) / pulse_width, 2));
}

struct Fields {
  std::vector<double> x, y, quadrilaterals, time, ux, uy, vx, vy;
  std::map<std::string, std::vector<double>> tensor;  ///< "strain_xx" and so on
};

Json sized(const char* id, int ny, int degree, double step_fraction) {
  Json json = shear_case(id);
  json["elements"] = {66, ny};
  json["degree"] = degree;
  json["time"]["step_fraction"] = step_fraction;
  json["receivers"] = {{"points", {{receiver_x, 0.0}}}};
  json["sample_every"] = 1;
  json["snapshots"] = 2;
  return json;
}

// All cases in one run of the program.
class ProgramFields : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    place_ = new Workplace;
    std::vector<Json> cases{sized("0.8", 1, 6, 0.8), sized("0.4", 1, 6, 0.4), sized("layers", 3, 2, 0.5), sized("linear", 1, 1, 0.5),
                            sized("driven", 1, 4, 0.5), sized("without", 1, 6, 0.8), sized("few steps", 1, 2, 0.5)};
    cases[4]["initial"] = nullptr;
    cases[4]["drive"] = {{"wave", "shear"}, {"shape", "sin2"}, {"duration", 1e-5}, {"amplitude", 1e-6}};
    cases[5].erase("snapshots");
    cases[6]["snapshots"] = 10;
    cases[6]["time"] = {{"step_fraction", 0.5}, {"steps", 4}};
    place_->write("cases.json", case_file(cases));
    const auto outcome = place_->run("cases.json -o signals.h5");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
    reader_ = new SignalsReader(*place_ / "signals.h5");
  }
  static void TearDownTestSuite() {
    delete reader_;
    delete place_;
  }

  static const SignalsReader& reader() { return *reader_; }
  static Fields fields(const std::string& id) {
    const auto read = [&](const char* name) { return reader_->values(id + "/fields/" + name); };
    Fields f{read("x"), read("y"), read("quadrilaterals"), read("time"), read("displacement_x"), read("displacement_y"), read("velocity_x"),
             read("velocity_y"), {}};
    for (const char* name : {"strain_xx", "strain_yy", "strain_xy", "stress_xx", "stress_yy", "stress_xy"}) f.tensor[name] = read(name);
    return f;
  }

 private:
  static inline Workplace* place_ = nullptr;
  static inline SignalsReader* reader_ = nullptr;
};

// Relative L2 errors over all points of the last snapshot.
struct Errors {
  double displacement = 0.0, velocity = 0.0, strain = 0.0;
};

Errors errors_of(const Fields& f) {
  const ReleasedPulse exact{gaussian, strip_length, 1};
  const double t = f.time.back(), h = 1e-11;  // of the central difference: (c h/width)^2 = 3e-9
  double u2 = 0.0, du2 = 0.0, v2 = 0.0, dv2 = 0.0, s2 = 0.0, ds2 = 0.0;
  const std::size_t last = f.uy.size() - f.x.size();
  for (std::size_t k = 0; k < f.x.size(); ++k) {
    const double u = exact(f.x[k], t, shear_speed);
    const double v = (exact(f.x[k], t + h, shear_speed) - exact(f.x[k], t - h, shear_speed)) / (2.0 * h);
    u2 += u * u;
    v2 += v * v;
    du2 += std::pow(f.uy[last + k] - u, 2);
    dv2 += std::pow(f.vy[last + k] - v, 2);
    const double d = 1e-8;  // of the central difference: (d/width)^2/6 = 2e-10
    const double slope = (exact(f.x[k] + d, t, shear_speed) - exact(f.x[k] - d, t, shear_speed)) / (2.0 * d);
    s2 += slope * slope;
    ds2 += std::pow(2.0 * f.tensor.at("strain_xy")[last + k] - slope, 2);
  }
  return {std::sqrt(du2 / u2), std::sqrt(dv2 / v2), std::sqrt(ds2 / s2)};
}

TEST_F(ProgramFields, ArePulsesOfDAlembertUpToTheErrorOfTheStep) {
  for (const char* id : {"0.8", "0.4"}) {
    const Fields f = fields(id);
    const double dt = reader().number(id, "time_step"), t = f.time.back(), c = shear_speed;
    // The leapfrog's frequency is omega (1 + (omega dt)^2/24): a phase of omega^3 dt^2 t/24. The spectrum of a Gaussian has
    // <k^6> = 15/8 width^-6, that of its slope <k^8>/<k^2> = 105/8. Terms without t and the fourth order are below
    // width/(c t) = 3 % of it, the error of space at degree 6 below 2 %.
    const double phase = std::pow(c / pulse_width, 3) * dt * dt * t / 24.0;
    const Errors e = errors_of(f);
    EXPECT_NEAR(e.displacement, std::sqrt(15.0 / 8.0) * phase, 0.05 * std::sqrt(15.0 / 8.0) * phase) << id;
    EXPECT_NEAR(e.velocity, std::sqrt(105.0 / 8.0) * phase, 0.05 * std::sqrt(105.0 / 8.0) * phase) << id;
    EXPECT_NEAR(e.strain, std::sqrt(105.0 / 8.0) * phase, 0.05 * std::sqrt(105.0 / 8.0) * phase) << id;
    for (std::size_t k = 0; k < f.ux.size(); ++k) {
      // A shear wave has no ux: round-off of a few thousand steps, 1e-12 of the amplitude and of c times the slope.
      ASSERT_LT(std::abs(f.ux[k]), 1e-12 * 1e-6);
      ASSERT_LT(std::abs(f.vx[k]), 1e-12 * 1e-6 * c / pulse_width);
    }
  }
}

// Hooke's law with G = E/2.6: sigma_xy = 2 G eps_xy, and nothing else in a shear wave but round-off, 1e-11 of it.
TEST_F(ProgramFields, HaveTheStressOfAShearWave) {
  const Fields f = fields("0.8");
  const double largest = 1e-6 / pulse_width * 1e10 / 2.6;
  ASSERT_EQ(f.tensor.at("stress_xy").size(), f.uy.size());
  for (std::size_t k = 0; k < f.uy.size(); ++k) {
    const double shear = 1e10 / 1.3 * f.tensor.at("strain_xy")[k];
    ASSERT_NEAR(f.tensor.at("stress_xy")[k], shear, 1e-12 * largest);
    ASSERT_LT(std::abs(f.tensor.at("stress_xx")[k]) + std::abs(f.tensor.at("stress_yy")[k]), 1e-11 * largest);
  }
}

TEST_F(ProgramFields, ComeAtEqualTimesAndTheLastAtTheEnd) {
  const Fields f = fields("0.8");
  const double dt = reader().number("0.8", "time_step");
  ASSERT_EQ(f.time.size(), 2u);
  for (int k = 0; k < 2; ++k) {
    EXPECT_GE(f.time[k], (k + 1) * 3.75e-6 * (1.0 - 1e-9));
    EXPECT_LE(f.time[k], (k + 1) * 3.75e-6 + 1.5 * dt);
  }
  EXPECT_EQ(fields("few steps").time.size(), 4u);  // one a step
}

TEST_F(ProgramFields, LeaveTheSignalsAsTheyAre) {
  EXPECT_EQ(reader().signals("0.8").points, reader().signals("without").points);
  EXPECT_FALSE(reader().contains("without/fields"));
  // The receiver at a node sees what the fields show there: weights of 1 and of round-off.
  const Fields f = fields("0.8");
  const auto signals = reader().signals("0.8");
  int seen = 0;
  for (std::size_t k = 0; k < f.x.size(); ++k) {
    if (std::abs(f.x[k] - receiver_x) > 1e-9 || f.y[k] > 1e-9) continue;
    ++seen;
    EXPECT_EQ(f.time.back(), signals.time.back());
    const double u = f.uy[f.x.size() + k];
    EXPECT_GT(std::abs(u), 1e-7);
    EXPECT_NEAR(u, signals.point(signals.time.size() - 1, 0, 1), 1e-12 * 1e-6);
  }
  EXPECT_EQ(seen, 1);
}

TEST_F(ProgramFields, HaveAnEdgeThatMovesAsPrescribed) {
  const Fields f = fields("driven");
  int seen = 0;
  for (std::size_t k = 0; k < f.x.size(); ++k) {
    if (f.x[k] > 1e-9) continue;
    ++seen;
    for (std::size_t n = 0; n < f.time.size(); ++n) {
      const double phase = pi * f.time[n] / 1e-5;
      EXPECT_NEAR(f.uy[n * f.x.size() + k], 1e-6 * std::pow(std::sin(phase), 2), 1e-12 * 1e-6);
      EXPECT_NEAR(f.vy[n * f.x.size() + k], 1e-6 * pi / 1e-5 * std::sin(2.0 * phase), 1e-12 * 1e-6 * pi / 1e-5);
    }
  }
  EXPECT_EQ(seen, 5);  // degree 4, one element, top and bottom both
}

// Between periodic edges the upper row of elements ends at the upper edge, not at the lower one.
TEST_F(ProgramFields, HaveAMeshThatCoversTheStripOnce) {
  for (const auto& [id, rows, degree] : {std::tuple("layers", 3u, 2u), std::tuple("linear", 1u, 1u), std::tuple("0.8", 1u, 6u)}) {
    const Fields f = fields(id);
    EXPECT_EQ(f.x.size(), (66 * degree + 1) * (rows * degree + 1)) << id;
    ASSERT_EQ(f.quadrilaterals.size(), 4 * 66 * degree * rows * degree) << id;
    double area = 0.0;
    for (std::size_t q = 0; q < f.quadrilaterals.size(); q += 4) {
      double twice = 0.0;
      for (std::size_t k = 0; k < 4; ++k) {
        const auto a = static_cast<std::size_t>(f.quadrilaterals[q + k]), b = static_cast<std::size_t>(f.quadrilaterals[q + (k + 1) % 4]);
        twice += f.x[a] * f.y[b] - f.x[b] * f.y[a];
      }
      EXPECT_GT(twice, 0.0) << id;  // anticlockwise
      area += 0.5 * twice;
    }
    EXPECT_NEAR(area, strip_length * strip_width, 1e-12 * strip_length * strip_width) << id;
    EXPECT_NEAR(*std::max_element(f.y.begin(), f.y.end()), strip_width, 1e-12) << id;
    // Both edges are one: the same bits.
    std::map<long, double> lower;
    for (std::size_t k = 0; k < f.x.size(); ++k) {
      if (f.y[k] < 1e-9) lower[std::lround(f.x[k] * 1e9)] = f.uy[k];
    }
    for (std::size_t k = 0; k < f.x.size(); ++k) {
      if (f.y[k] < strip_width - 1e-9) continue;
      EXPECT_EQ(lower.at(std::lround(f.x[k] * 1e9)), f.uy[k]) << id;
    }
  }
}

TEST_F(ProgramFields, AreRefusedWhereTheyAreTooMany) {
  const Workplace place;
  Json many = shear_case("many");
  many["snapshots"] = 10'000;
  place.write("cases.json", case_file({many}));
  const auto outcome = place.run("cases.json -o signals.h5");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.errors.find("case \"many\", snapshots: 10000 of 8480 nodes make 6.78e+09 bytes"), std::string::npos) << outcome.errors;
}

}  // namespace
}  // namespace ddem::fem
