// Outputs never cost the user what was there, and never look written when they are not.

#include "tests/harness/cli/program.h"

namespace ddem::harness::test {
namespace {

class Outputs : public Cli {};

TEST_F(Outputs, NeverReplaceTheSceneOrWhatItReads) {
  write("scene.toml", file_scene());
  write("discs.csv", disc_table(small_lattice()));
  const auto before = contents();
  for (const std::string victim : {"scene.toml", "discs.csv"}) {
    const SubprocessResult r = ddem({"run", path("scene.toml"), "--signals", path(victim)});
    EXPECT_EQ(r.exit_code, 2);
    EXPECT_THAT(r.standard_error, testing::HasSubstr("would overwrite"));
    EXPECT_EQ(ddem({"pack", path("scene.toml"), "-o", path(victim)}).exit_code, 2);
  }
  expect_contents(before);
}

TEST_F(Outputs, TwoOfOneNameAreRefused) {
  write("scene.toml", small_scene());
  EXPECT_EQ(ddem({"run", path("scene.toml"), "-o", path("x"), "--signals", path("x")}).exit_code, 2);
  EXPECT_FALSE(contents().contains("x"));
}

TEST_F(Outputs, ImplicitStrainsRunAndConserve) {
  write("scene.toml", with_table(small_scene(), "[deformation]\nscheme = \"implicit\"\ncorrection = \"full\"\nyoung_modulus = 1e9\n"
                                                "poisson_ratio = 0.3"));
  const SubprocessResult r = ddem({"run", path("scene.toml")});
  EXPECT_EQ(r.exit_code, 0) << r.standard_error;
  EXPECT_THAT(r.standard_error, testing::Not(testing::HasSubstr("unstable")));
}

TEST_F(Outputs, AnEvenNumberOfEvaluationsIsWarnedOf) {
  write("scene.toml", with_table(small_scene(), "[deformation]\nevaluations = 2\nyoung_modulus = 4e10\npoisson_ratio = 0.3"));
  EXPECT_THAT(ddem({"run", path("scene.toml")}).standard_error, testing::HasSubstr("adds energy"));
}

}  // namespace
}  // namespace ddem::harness::test
