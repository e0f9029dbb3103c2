// ddem-fem as a whole, against exact solutions.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

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

double gaussian(double x) {
  return 1e-6 * std::exp(-0.5 * std::pow((x - 3e-3) / 3e-4, 2));
}

// All cases of the tests below in one run: a start of the program costs more than most of them.
class Program : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    place_ = new Workplace;
    place_->write("cases.json", case_file(cases()));
    const auto outcome = place_->run("cases.json -o signals.h5 --progress");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
    EXPECT_EQ(outcome.output, "");
    EXPECT_EQ(outcome.errors.substr(0, 11), "done shear\n");
    reader_ = new SignalsReader(*place_ / "signals.h5");
  }
  static void TearDownTestSuite() {
    delete reader_;
    delete place_;
  }

  static std::vector<Json> cases();
  static Signals signals(const std::string& id) { return reader_->signals(id); }
  static const SignalsReader& reader() { return *reader_; }

 private:
  static inline Workplace* place_ = nullptr;
  static inline SignalsReader* reader_ = nullptr;
};

Json driven(Json base, const std::string& wave) {
  base["initial"] = nullptr;
  base["drive"] = {{"wave", wave}, {"shape", "sin2"}, {"duration", 3e-6}, {"amplitude", 1e-6}};
  return base;
}

Json sized(Json base, int nx, int ny, int degree, double step_fraction) {
  base["elements"] = {nx, ny};
  base["degree"] = degree;
  base["time"]["step_fraction"] = step_fraction;
  return base;
}

std::vector<Json> Program::cases() {
  std::vector<Json> all{shear_case("shear"), bar_case("bar"), driven(shear_case("driven shear"), "shear"),
                        driven(bar_case("driven bar"), "longitudinal")};
  all.push_back(shear_case("p wave"));
  all.back()["initial"]["wave"] = "longitudinal";
  all.back()["plane"] = "strain";
  all.back()["time"]["end"] = 3e-6;
  // The error of time alone, at degree 6.
  all.push_back(sized(shear_case("step 0.8"), 66, 1, 6, 0.8));
  all.push_back(sized(shear_case("step 0.4"), 66, 1, 6, 0.4));
  all.push_back(sized(bar_case("column"), 33, 4, 2, 0.5));
  all.back()["initial"] = {
      {"wave", "longitudinal"}, {"shape", "column"}, {"amplitude", 1e-6}, {"spacing", 5e-4}};
  all.back()["receivers"]["points"] = {{0, 0}, {2.5e-4, 1e-3}, {5e-4, 2e-3}, {strip_length, strip_width}};
  all.back()["receivers"]["sections"] = {0.0, strip_length};
  all.back()["right"] = "fixed";
  all.push_back(all.back());
  all.back()["id"] = "cosine";
  all.back()["initial"] = {{"wave", "shear"}, {"shape", "cosine"}, {"amplitude", 1e-6}, {"width", 5e-4}};
  all.push_back(sized(bar_case("contracting bar"), 33, 4, 4, 0.5));
  all.back()["poisson_ratio"] = 0.3;
  return all;
}

TEST_F(Program, ShearPulseIsDAlembert) {
  const ReleasedPulse exact{gaussian, strip_length, 1};
  const Difference d = compare(signals("shear"), receiver_places(), 1, exact, shear_speed);
  EXPECT_LT(d.relative_l2, 1e-4);  // 3e-5 of space, 4e-5 of the time step
  EXPECT_LT(std::abs(d.speed), 1e-5);
  // The comparison can fail: 3 % in the modulus is 1.5 % in the speed.
  EXPECT_NEAR(compare(signals("shear"), receiver_places(), 1, exact, 1.0001 * shear_speed).speed, -1e-4,
              1e-5);
}

TEST_F(Program, BarWithoutContractionIsDAlembertWithReflection) {
  // 7.5 us are 18.2 mm: the pulse returns from the fixed end, upside down.
  const ReleasedPulse exact{gaussian, strip_length, -1};
  const Difference d = compare(signals("bar"), receiver_places(), 0, exact, bar_speed);
  EXPECT_LT(d.relative_l2, 2e-4);
  EXPECT_LT(std::abs(d.speed), 1e-5);
}

TEST_F(Program, PlaneStrainBetweenPeriodicEdgesHasThePSpeed) {
  const double p_speed = std::sqrt(1e10 * 0.7 / (1.3 * 0.4) / 1700.0);
  const ReleasedPulse exact{gaussian, strip_length, -1};
  const Difference d = compare(signals("p wave"), receiver_places(), 0, exact, p_speed);
  EXPECT_LT(d.relative_l2, 2e-4);
  EXPECT_LT(std::abs(d.speed), 1e-5);
}

TEST_F(Program, SectionsOfPlaneWavesEqualTheirPoints) {
  for (const char* id : {"shear", "bar"}) {
    const Signals s = signals(id);
    ASSERT_GT(s.time.size(), 1000u);
    double worst = 0.0;
    for (std::size_t k = 0; k < s.points.size(); ++k)
      worst = std::max(worst, std::abs(s.points[k] - s.sections[k]));
    EXPECT_LT(worst, 1e-12 * 1e-6) << id;
  }
}

TEST_F(Program, SectionIsTheAverageOfABentCrossSection) {
  // With nu = 0.3 the free edges move against each other: points differ from the average, uy cancels in it.
  const Signals s = signals("contracting bar");
  double lateral = 0.0, average = 0.0;
  for (std::size_t sample = 0; sample < s.time.size(); ++sample) {
    lateral = std::max(lateral, std::abs(s.point(sample, 2, 1)));
    average = std::max(average, std::abs(s.section(sample, 2, 1)));
  }
  EXPECT_GT(lateral, 1e-8);
  EXPECT_LT(average, 1e-11 * lateral);
}

TEST_F(Program, DrivenEdgeSendsItsMotionDownTheStrip) {
  const auto edge = [](double t) {
    return t > 0.0 && t < 3e-6 ? 1e-6 * std::pow(std::sin(pi * t / 3e-6), 2) : 0.0;
  };
  for (const bool shear : {true, false}) {
    // Before the far end sends an echo back: receivers up to 12.7 mm, the echo passes them after 20.3 mm.
    const auto exact = [&](double x, double t, double speed) {
      const double echo = edge(t - (2.0 * strip_length - x) / speed);
      return edge(t - x / speed) + (shear ? echo : -echo);
    };
    const Signals s = signals(shear ? "driven shear" : "driven bar");
    const Difference d = compare(s, receiver_places(), shear ? 1 : 0, exact, shear ? shear_speed : bar_speed);
    EXPECT_LT(d.relative_l2, 2e-4);
    EXPECT_LT(std::abs(d.speed), 1e-5);
  }
}

TEST_F(Program, ErrorConvergesWithTheStep) {
  const ReleasedPulse exact{gaussian, strip_length, 1};
  const auto error = [&](const char* id) {
    return compare(signals(id), receiver_places(), 1, exact, shear_speed).relative_l2;
  };
  EXPECT_NEAR(std::log2(error("step 0.8") / error("step 0.4")), 2.0, 0.05);
}

TEST_F(Program, ProfilesAreThoseOfTheInterface) {
  // Quadratic elements of 0.5 mm: nodes at 0, 0.25 and 0.5 mm, where both profiles are known.
  const Signals column = signals("column"), cosine = signals("cosine");
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(column.point(0, k, 0), 1e-6 * (1.0 - 0.5 * k), 1e-20);
    EXPECT_EQ(column.point(0, k, 1), 0.0);
    EXPECT_NEAR(cosine.point(0, k, 1), 1e-6 * (1.0 - 0.5 * k), 1e-20);
    EXPECT_EQ(cosine.point(0, k, 0), 0.0);
  }
  EXPECT_NEAR(column.section(0, 0, 0), 1e-6, 1e-20);
}

TEST_F(Program, FixedEdgeStaysAndTheFreeOneMoves) {
  const Signals s = signals("column");
  double free_end = 0.0;
  for (std::size_t sample = 0; sample < s.time.size(); ++sample) {
    EXPECT_EQ(s.point(sample, 3, 0), 0.0);
    EXPECT_EQ(s.point(sample, 3, 1), 0.0);
    free_end = std::max(free_end, std::abs(s.point(sample, 0, 0) - 1e-6));
  }
  EXPECT_GT(free_end, 1e-7);
}

TEST_F(Program, AttributesSayWhatRan) {
  EXPECT_EQ(reader().number("shear", "dofs"), 2 * (66 * 4 + 1) * (8 * 4));  // periodic: top row merged
  EXPECT_EQ(reader().number("bar", "dofs"), 2 * (66 * 4 + 1) * (8 * 4 + 1));
  EXPECT_EQ(reader().text("shear", "status"), "ok");
  const double step = reader().number("shear", "time_step");
  EXPECT_DOUBLE_EQ(step, 0.1 * reader().number("shear", "critical_time_step"));
  EXPECT_EQ(reader().number("shear", "steps"), std::ceil(7.5e-6 / step));
  const Signals s = signals("shear");
  EXPECT_EQ(s.time.size(), 1 + std::size_t(std::ceil(7.5e-6 / step)) / 4);
  EXPECT_DOUBLE_EQ(s.time[10], 40 * step);
  for (const char* id : {"shear", "bar", "driven bar", "contracting bar"}) {
    EXPECT_LT(reader().number(id, "energy_drift"), 1e-12) << id;
  }
}

TEST(ProgramRun, GivesTheSameBitsForAnyNumberOfThreads) {
  const Workplace place;
  Json shear = sized(shear_case("shear"), 33, 4, 4, 0.5);
  place.write("cases.json", case_file({shear}));
  const auto signals = [&](const std::string& options) {
    EXPECT_EQ(place.run("cases.json -o signals.h5" + options).exit_code, 0);
    return SignalsReader(place / "signals.h5").signals("shear").points;
  };
  const auto once = signals("");
  EXPECT_EQ(signals(""), once);
  EXPECT_EQ(signals(" --threads 2"), once);
  EXPECT_EQ(place.run("cases.json -o other.h5 --threads 0").exit_code, 2);
}

TEST(ProgramRun, StopsWhereItBlowsUpAndFinishesTheOthers) {
  const Workplace place;
  // Lateral contraction couples the bar to all modes; a plane shear wave has no part in the fastest ones.
  Json wild = sized(bar_case("wild"), 33, 4, 4, 1.01), tame = sized(bar_case("tame"), 33, 4, 4, 0.99);
  wild["poisson_ratio"] = tame["poisson_ratio"] = 0.3;
  place.write("cases.json", case_file({wild, tame}));
  const auto outcome = place.run("cases.json -o signals.h5");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.errors.find("case \"wild\": unstable: step "), std::string::npos) << outcome.errors;
  const SignalsReader reader(place / "signals.h5");
  EXPECT_EQ(reader.text("tame", "status"), "ok");
  EXPECT_EQ(reader.text("wild", "status").substr(0, 15), "unstable: step ");
  EXPECT_FALSE(reader.has("wild", "energy_drift"));
  const Signals kept = reader.signals("wild");
  EXPECT_EQ(kept.points.size(), kept.time.size() * 20);
  for (const double u : kept.points) ASSERT_LE(std::abs(u), 1e-3);
}

TEST(ProgramRun, RefusesWrongInputAndLeavesNothing) {
  const Workplace place;
  Json wrong = shear_case("slip");
  wrong["density"] = -1;
  place.write("cases.json", case_file({wrong}));
  auto outcome = place.run("cases.json -o signals.h5");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.errors.find("case \"slip\", density"), std::string::npos) << outcome.errors;
  EXPECT_EQ(place.run("missing.json -o signals.h5").exit_code, 2);
  EXPECT_EQ(place.run("cases.json").exit_code, 2);
  EXPECT_EQ(place.run("cases.json -o signals.h5 --colour").exit_code, 2);
  Json endless = shear_case("endless");
  endless["time"]["end"] = 1e9;
  place.write("cases.json", case_file({endless}));
  outcome = place.run("cases.json -o signals.h5");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.errors.find("case \"endless\", time"), std::string::npos) << outcome.errors;
  EXPECT_EQ(place.file_count(), 1u);
}

TEST(ProgramRun, SaysWhenTheMachineFails) {
  const Workplace place;
  place.write("cases.json", case_file({sized(shear_case("shear"), 2, 1, 1, 0.5)}));
  EXPECT_EQ(place.run("cases.json -o no/such/folder/signals.h5").exit_code, 4);
  EXPECT_EQ(place.run("cases.json -o .").exit_code, 4);
}

TEST(ProgramRun, ExplainsItself) {
  const Workplace place;
  const auto help = place.run("--help"), version = place.run("--version");
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_NE(help.output.find("CASES.json"), std::string::npos);
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_NE(version.output.find("deal.II"), std::string::npos);
}

}  // namespace
}  // namespace ddem::fem
