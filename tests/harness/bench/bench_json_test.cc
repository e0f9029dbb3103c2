// The shape of the result, and that nothing in it is NaN or null.

#include <gtest/gtest.h>

#include <limits>

#include "harness/bench/bench.h"
#include "harness/bench/bench_report.h"

namespace ddem::harness::bench {
namespace {

BenchPlan small_plan() {
  BenchPlan plan;
  plan.kernel_plans = {{Arrangement::lattice, 120, 10, 2, false, false, {1}}};
  plan.fem_kernels = {{{4, {16, 2}}}, {1, 2}, 5e-6, 1, 2};
  plan.discs = {{16}, {0.5}, 0.0};
  plan.fem_meshes = {{2, {33, 1}}};
  plan.fem_repetitions = 1;
  plan.peers = plan.scaling = false;
  return plan;
}

TEST(Bench, HasItsPartsAsJson) {
  std::size_t heard = 0;
  const BenchPlan plan = small_plan();
  const BenchResults results = run_bench(plan, [&] { ++heard; });
  EXPECT_EQ(heard, results.fem_failure.empty() ? bench_work(plan) : bench_work(plan) - 2);
  const Json j = Json::parse(to_text(bench_json(results)));  // to_text throws on numbers that are none
  ASSERT_EQ(j["kernels"].size(), 2u);
  for (const char* key : {"law", "discs", "threads", "nanoseconds_per_bond_step"}) EXPECT_TRUE(j["kernels"][0].contains(key)) << key;
  ASSERT_EQ(j["work_precision"].size(), results.fem_failure.empty() ? 7u : 5u);
  for (const auto& p : j["work_precision"]) {
    for (const char* key : {"solver", "scheme", "discs_or_dofs", "step_fraction", "seconds", "error"}) EXPECT_TRUE(p.contains(key)) << key;
    EXPECT_GT(p["seconds"].get<double>(), 0.0);
    EXPECT_GT(p["error"].get<double>(), 0.0);
  }
  if (results.fem_failure.empty()) {
    ASSERT_EQ(j["fem_kernels"].size(), 2u);
    for (const auto& k : j["fem_kernels"]) {
      EXPECT_GT(k["dof_steps_per_second"].get<double>(), 0.0);
      EXPECT_TRUE(k["same_bits"].get<bool>());
    }
    EXPECT_EQ(j["fem_kernels"][0]["over_one_thread"], 1.0);
  }
  EXPECT_EQ(j["scaling"], Json::array());
  EXPECT_EQ(j["peers"], Json::array());
  EXPECT_EQ(j["peers_reason"], "not asked for");
  EXPECT_GT(j["triad_gb_per_s"].get<double>(), 0.0);
}

TEST(Bench, AnUnstableRunIsAStatusNotANumber) {
  BenchResults results;
  results.triad = std::numeric_limits<double>::quiet_NaN();
  results.work_precision = {{"DDEM", "lagged", "62 x 12", 744, 1.0, 80, 1e-3, 0.0, 0.0, "unstable: step 64"}};
  const Json j = bench_json(results);
  EXPECT_EQ(j["work_precision"][0]["error"]["status"], "unstable: step 64");
  EXPECT_TRUE(j["triad_gb_per_s"].contains("status"));
  EXPECT_NO_THROW(to_text(j));
}

TEST(Bench, ReportDrawsALineForEachDegreeAndScheme) {
  BenchResults results;
  results.peers.reason = "not installed";
  for (const char* scheme : {"p1, shear", "p1, bar", "p8, shear"}) {
    for (const double seconds : {1e-3, 1e-2}) results.work_precision.push_back({"FE", scheme, "8 x 1", 100, 0.99, 10, seconds, 1e-6 / seconds, 1e-6 / seconds, "ok"});
  }
  results.work_precision.push_back({"DEM", "rigid", "62 x 12", 744, 0.5, 10, 1e-3, 1e-2, 2e-2, "ok"});
  const reports::Figure figure = precision_figure(results.work_precision);
  ASSERT_EQ(figure.panels.size(), 3u);
  const auto& fem = std::get<reports::Plot>(figure.panels[0]);
  ASSERT_EQ(fem.series.size(), 3u);
  EXPECT_EQ(fem.series[0].x.size(), 2u);
  EXPECT_EQ(fem.x.scale, reports::Scale::log);
  const std::string page = reports::render_html(bench_report(results));
  EXPECT_NE(page.find("not installed"), std::string::npos);
  EXPECT_NE(page.find("Work-precision"), std::string::npos);
}

}  // namespace
}  // namespace ddem::harness::bench
