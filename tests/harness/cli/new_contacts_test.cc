// New contacts as a user sees them: packing, bonds and state from files, pieces apart.

#include <cmath>

#include "harness/io/json.h"
#include "harness/io/signals_csv.h"
#include "tests/harness/cli/program.h"

namespace ddem::harness::test {
namespace {

using testing::HasSubstr;

class NewContactsRun : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    write("discs.csv", "x,y,radius\n1e-4,1e-4,1e-4\n3e-4,1e-4,1e-4\n5.0001e-4,1e-4,1e-4\n");
    write("bonds.csv", "i,j\n0,1\n");
    write("u0.csv", "ux,uy,theta\n2e-8,0,0\n-2e-8,0,0\n0,0,0\n");
    write("scene.toml", scene_);
  }
  const std::string scene_ =
      "[assembly]\npacking = \"file\"\nfile = \"discs.csv\"\nbonds = \"bonds.csv\"\n[material]\ndensity = 2000.0\n"
      "[contact]\nnormal_stiffness = 1e10\nstiffness_ratio = 0.0\n[boundary]\ntop_bottom = \"free\"\nright = \"free\"\n"
      "[initial]\ndisplacement = \"u0.csv\"\n[time]\nstep_fraction = 0.1\nsteps = 100\n[probes]\ndiscs = [0, 1, 2]\n";
};

TEST_F(NewContactsRun, TheThirdDiscWaitsForTheSecond) {
  const auto run = ddem({"run", path("scene.toml"), "--json", "--signals", path("s.csv")});
  ASSERT_EQ(run.exit_code, 0) << run.standard_error;
  EXPECT_THAT(run.standard_error, HasSubstr("new contacts from step"));
  const Json json = Json::parse(run.standard_output);
  const auto first = json["new_contacts"]["first_step"].get<std::size_t>();
  // u_1 = -2e-8 cos(w t) is 1e-8 at a third of the period, 2 pi sqrt(m / 2 k) = 2 pi (critical step) / 2.
  EXPECT_EQ(first, static_cast<std::size_t>(std::ceil(M_PI / 3.0 / 0.1)));
  const SignalTable s = read_signals_csv(in_folder("s.csv"));
  const auto& third = s.channels.at(6);
  for (std::size_t n = 0; n <= first; ++n) EXPECT_EQ(third[n], 0.0) << n;
  EXPECT_GT(third.back(), 1e-8);
  for (std::size_t n = 0; n < s.time.size(); ++n) {
    EXPECT_NEAR(s.channels[0][n] + s.channels[3][n] + third[n], 0.0, 1e-20) << n;  // equal masses: momentum
  }
}

TEST_F(NewContactsRun, AreNotExactInTime) {
  const std::string exact = replaced(scene_, "[time]\n", "[time]\nintegrator = \"exact\"\n");
  write("scene.toml", exact);
  expect_refused({"time.integrator = \"exact\": discs that are not bonded come to touch", "use integrator = \"verlet\", lower the amplitude"});
  // A third of the amplitude leaves the gap open.
  write("u0.csv", "ux,uy,theta\n3e-9,0,0\n-3e-9,0,0\n0,0,0\n");
  EXPECT_EQ(ddem({"run", path("scene.toml")}).exit_code, 0);
}

TEST_F(NewContactsRun, AreSwitchedOff) {
  write("scene.toml", replaced(scene_, "stiffness_ratio = 0.0", "stiffness_ratio = 0.0\nnew_contacts = \"off\""));
  const auto run = ddem({"run", path("scene.toml")});
  // Then a disc without a bond is a mistake, as it was.
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.standard_error, HasSubstr("networks without a bond"));
}

TEST_F(NewContactsRun, StaticsNeedOnePiece) {
  write("bonds.csv", "i,j\n0,1\n");
  const auto run = ddem({"moduli", path("scene.toml")});
  EXPECT_EQ(run.exit_code, 2);
}

TEST_F(NewContactsRun, AStepTooLongForClosedContactsIsAWarning) {
  write("scene.toml", replaced(scene_, "step_fraction = 0.1", "step_fraction = 0.95"));
  const auto run = ddem({"run", path("scene.toml")});
  EXPECT_THAT(run.standard_error, HasSubstr("were all that are near to close"));
}

}  // namespace
}  // namespace ddem::harness::test
