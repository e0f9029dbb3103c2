// Campaigns by another solver: the same verdicts, resumed and in parts; what it cannot do is skipped, and what it gets wrong is found.

#include <fmt/format.h>

#include "harness/io/json.h"
#include "tests/harness/cli/numpy.h"
#include "tests/harness/cli/small_campaign.h"

namespace ddem::harness::test {
namespace {

using testing::HasSubstr;

class SolverCampaign : public SmallCampaign {
 protected:
  void SetUp() override {
    SmallCampaign::SetUp();
    write("campaign.toml", R"([[case]]
id = "small"
scene = "scene.toml"
[case.matrix]
"contact.stiffness_ratio" = [0.1, 0.3]
[[case.criterion]]
metric = "wave_speed"
target = "static.p_velocity"
lower = -0.5
upper = 0.5
unit = "m/s"
derivation = "anything near"
)");
  }
  static std::string example() { return DDEM_SOURCES "/harness/solvers/examples/ddem_numpy.toml"; }
  Json metric_of(const std::string& folder, std::size_t k) const { return read_json(in_folder(folder) / "summary.json")["cases"][k]["criteria"][0]["actual"]; }
};

TEST_F(SolverCampaign, IsJudgedAsTheBuiltInOne) {
  NEEDS_NUMPY();
  ASSERT_EQ(validate("ours").exit_code, 0);
  const auto run = validate("theirs", {"--solver", example()});
  ASSERT_EQ(run.exit_code, 0) << run.standard_output << run.standard_error;
  EXPECT_THAT(run.standard_output, HasSubstr("2 of 2 passed"));
  for (const std::size_t k : {0u, 1u}) {
    const double ours = metric_of("ours", k).get<double>();
    EXPECT_NEAR(metric_of("theirs", k).get<double>(), ours, 1e-10 * ours);
  }
  const Json summary = read_json(in_folder("theirs/summary.json"));
  EXPECT_EQ(summary["provenance"]["solver"], example());
  EXPECT_THAT(summary["cases"][0]["reproduce"].get<std::string>(), HasSubstr("--solver " + example()));

  // Resumed: what is there stays; by another solver it is another campaign.
  std::filesystem::remove(in_folder("theirs") / "cases/case/small/stiffness_ratio=0.1.unit");
  const std::string expected = outcome("theirs");
  ASSERT_EQ(validate("theirs", {"--solver", example(), "--resume"}).exit_code, 0);
  EXPECT_EQ(outcome("theirs"), expected);
  EXPECT_EQ(validate("theirs", {"--resume"}).exit_code, 2);
  const auto replaced = validate("theirs");
  EXPECT_EQ(replaced.exit_code, 2);
  EXPECT_THAT(replaced.standard_error, HasSubstr("solver"));
  for (const char* i : {"1", "2"})
    ASSERT_EQ(validate(std::string("shard-") + i, {"--solver", example(), "--shard", std::string(i) + "/2"}).exit_code, 0);
  ASSERT_EQ(ddem({"merge", path("shard-1"), path("shard-2"), "-o", path("merged")}).exit_code, 0);
  EXPECT_EQ(outcome("merged"), expected);
}

TEST_F(SolverCampaign, WhatItCannotDoIsSkipped) {
  NEEDS_NUMPY();
  write("scene.toml", with_table(small_scene(), "[deformation]\nscheme = \"implicit\"\nyoung_modulus = 4e10\npoisson_ratio = 0.3"));
  const auto run = validate("night", {"--solver", example()});
  EXPECT_EQ(run.exit_code, 0) << run.standard_output;
  EXPECT_THAT(run.standard_output, HasSubstr("SKIPPED"));
  const Json summary = read_json(in_folder("night/summary.json"));
  EXPECT_EQ(summary["cases"][0]["state"], "SKIPPED");
  EXPECT_THAT(summary["cases"][0]["reason"].get<std::string>(), HasSubstr("has no law implicit-normal"));
}

TEST_F(SolverCampaign, ItsErrorsAreErrorsOfTheCases) {
  write("solver.toml", "name = \"odd\"\ncommand = [\"sh\", \"-c\", \"echo no licence >&2; exit 3\", \"{folder}\"]\nlaws = [\"dem\"]\n");
  const auto run = validate("night", {"--solver", path("solver.toml")});
  EXPECT_EQ(run.exit_code, 1);
  const Json summary = read_json(in_folder("night/summary.json"));
  EXPECT_EQ(summary["cases"][0]["state"], "ERROR");
  EXPECT_THAT(summary["cases"][0]["reason"].get<std::string>(), HasSubstr("odd: exit code 3; it said: no licence"));
}

}  // namespace
}  // namespace ddem::harness::test
