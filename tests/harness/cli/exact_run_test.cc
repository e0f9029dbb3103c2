// integrator = "exact" as a user sees it.

#include <algorithm>
#include <cmath>

#include "harness/io/hdf5.h"
#include "harness/io/json.h"
#include "harness/io/signals_csv.h"
#include "tests/harness/cli/program.h"

namespace ddem::harness::test {
namespace {

class ExactRun : public Cli {
 protected:
  /// small_scene() driven by a smooth pulse, and what stands in [time].
  std::string scene(const std::string& time) const {
    std::string text = small_scene();
    text.replace(text.find("[initial]"), text.find("[probes]") - text.find("[initial]"),
                 "[drive]\nwave = \"shear\"\nduration = \"2 us\"\namplitude = \"1 nm\"\n[time]\nend = \"4 us\"\n" + time + "\n");
    return text;
  }
  std::vector<double> signal(const std::string& time) const {
    write("scene.toml", scene(time));
    const auto run = ddem({"run", path("scene.toml"), "--signals", path("s.csv"), "--json"});
    EXPECT_EQ(run.exit_code, 0) << run.standard_error;
    return read_signals_csv(in_folder("s.csv")).channels.at(1);
  }
};

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  EXPECT_EQ(a.size(), b.size());
  double most = 0.0;
  for (std::size_t n = 0; n < std::min(a.size(), b.size()); ++n) most = std::max(most, std::abs(a[n] - b[n]));
  return most;
}

TEST_F(ExactRun, IsWhereVerletConvergesTo) {
  const auto exact = signal("integrator = \"exact\"\nstep = 4e-9");
  const auto coarse = signal("step = 4e-9"), fine = signal("step = 2e-9\nsample_every = 2");
  EXPECT_NEAR(std::log2(largest_difference(coarse, exact) / largest_difference(fine, exact)), 2.0, 0.02);
}

TEST_F(ExactRun, MarchesJustBelowTheCriticalStep) {
  write("scene.toml", replaced(small_scene(), "[probes]", "[time]\nintegrator = \"exact\"\n[probes]"));
  const auto run = ddem({"run", path("scene.toml"), "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.standard_error;
  const Json json = Json::parse(run.standard_output);
  EXPECT_DOUBLE_EQ(json["time_step"].get<double>(), 0.99 * json["critical_time_step"].get<double>());
  EXPECT_LT(json["energy_drift"].get<double>(), 1e-12);
  EXPECT_EQ(json["good_pairs"], 3);
}

TEST_F(ExactRun, KeepsSignalsAlone) {
  write("scene.toml", scene("integrator = \"exact\""));
  ASSERT_EQ(ddem({"run", path("scene.toml"), "-o", path("r.h5")}).exit_code, 0);
  const Hdf5File file = Hdf5File::open(in_folder("r.h5"));
  EXPECT_GT(file.root().group("signals").read_doubles("time").values.size(), 10u);
  const auto refused = ddem({"run", path("scene.toml"), "-o", path("s.h5"), "--snapshots", "2"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.standard_error, testing::HasSubstr("snapshots of all discs are not exact in time"));
}

TEST_F(ExactRun, RefusesMoreSamplesThanItCanFilter) {
  write("scene.toml", replaced(scene("integrator = \"exact\"\nstep = 6e-11"), "4 us", "1 ms"));
  const auto refused = ddem({"run", path("scene.toml")});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.standard_error, testing::HasSubstr("multiplications; raise time.sample_every"));
}

}  // namespace
}  // namespace ddem::harness::test
