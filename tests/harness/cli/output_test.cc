// What a run says of itself besides its results.

#include "tests/harness/cli/program.h"

namespace ddem::harness::test {
namespace {

class Outputs : public Cli {};

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
