// ddem-fem on two processes (mpirun) against one: the same receivers.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fem_reference/case_builder.h"
#include "tests/fem_reference/program.h"

namespace ddem::fem {
namespace {

using test::bar_case;
using test::case_file;
using test::Json;
using test::shear_case;
using test::Signals;
using test::SignalsReader;
using test::Workplace;

Json small(Json base, const char* integrator) {
  base["elements"] = {33, 4};
  base["time"] = {{"integrator", integrator}, {"step_fraction", 0.5}, {"end", 6e-6}};
  return base;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  EXPECT_EQ(a.size(), b.size());
  double difference = 0.0;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) difference = std::max(difference, std::abs(a[k] - b[k]));
  return difference;
}

TEST(Mpi, TwoProcessesGiveTheReceiversOfOne) {
  const Workplace place;
  Json contracting = small(bar_case("contracting bar"), "verlet");
  contracting["poisson_ratio"] = 0.3;
  Json driven = small(shear_case("driven"), "exact");
  driven["initial"] = nullptr;
  driven["drive"] = {{"wave", "shear"}, {"shape", "sin2"}, {"duration", 3e-6}, {"amplitude", 1e-6}};
  place.write("cases.json", case_file({small(shear_case("shear"), "exact"), contracting, driven}));
  ASSERT_EQ(place.run("cases.json -o one.h5").exit_code, 0);
  const auto outcome = place.run("cases.json -o two.h5 --progress", DDEM_MPIRUN " -np 2 ");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(outcome.errors, "done shear\ndone contracting bar\ndone driven\n");  // the first process alone speaks
  const SignalsReader one(place / "one.h5"), two(place / "two.h5");
  for (const char* id : {"shear", "contracting bar", "driven"}) {
    // Sums of the nodes on the cut and of Lanczos come in another order. Measured: 5e-15 of the amplitude; a driven
    // edge 7e-13 at most, since its response is a sum of states as large as (omega_max duration)^2/steps amplitudes.
    const Signals a = one.signals(id), b = two.signals(id);
    EXPECT_LT(largest_difference(a.points, b.points), 1e-12 * 1e-6) << id;
    EXPECT_LT(largest_difference(a.sections, b.sections), 1e-12 * 1e-6) << id;
    EXPECT_LT(largest_difference(a.time, b.time), 1e-12 * 6e-6) << id;
    EXPECT_EQ(one.number(id, "dofs"), two.number(id, "dofs")) << id;
    EXPECT_LT(two.number(id, "energy_drift"), 1e-12) << id;
  }
}

TEST(Mpi, RefusesSnapshots) {
  const Workplace place;
  Json snapshots = small(shear_case("shear"), "verlet");
  snapshots["snapshots"] = 2;
  place.write("cases.json", case_file({snapshots}));
  const auto outcome = place.run("cases.json -o signals.h5", DDEM_MPIRUN " -np 2 ");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.errors.find("case \"shear\", snapshots: need one process"), std::string::npos) << outcome.errors;
  EXPECT_FALSE(std::filesystem::exists(place / "signals.h5"));
}

TEST(Mpi, MistakesEndAllProcesses) {
  const Workplace place;
  place.write("cases.json", case_file({small(shear_case("shear"), "exact")}));
  EXPECT_NE(place.run("cases.json -o no/such/folder/signals.h5", DDEM_MPIRUN " -np 2 ").exit_code, 0);
  place.write("wrong.json", "{}");
  EXPECT_EQ(place.run("wrong.json -o signals.h5", DDEM_MPIRUN " -np 2 ").exit_code, 2);
}

}  // namespace
}  // namespace ddem::fem
