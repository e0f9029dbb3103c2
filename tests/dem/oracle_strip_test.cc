// A longitudinal pulse in a hexagonal strip against LAMMPS (k_t = 0) and Yade (k_t = k_n/2): tests/oracles/hex_strip.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dem/assembly/contacts.h"
#include "dem/simulation/simulation.h"
#include "tests/support/oracle_files.h"

namespace ddem {
namespace {

struct Oracle {
  std::string file;
  double stiffness_ratio;
  double time_step;
};

const Oracle kLammps = {"hex_strip/lambda0.lammps.csv", 0.0, 8.587906437464980e-09};
const Oracle kYade = {"hex_strip/lambda05.yade.csv", 0.5, 6.072494887660347e-09};

Assembly strip() {
  const Packing p = test::oracle_packing("hex_strip/discs.csv", {}, 62 * 0.264e-3, 11 * 0.264e-3 * std::sqrt(0.75));
  std::vector<std::pair<int, int>> pairs;
  for (const auto& row : test::oracle_rows("hex_strip/bonds.csv")) pairs.emplace_back(std::stoi(row[0]), std::stoi(row[1]));
  return make_assembly(p, bonds_between(p, pairs), 1.0, 2000.0);
}

SimulationInput scene(const Assembly& a, const Oracle& oracle, Kinematics kinematics) {
  SimulationInput in;
  in.contact = {1e10, oracle.stiffness_ratio, kinematics};
  in.held.x.assign(a.size(), 0);
  for (const int d : edge_discs(a.packing, Edge::right, 1.2 * mean_radius(a.packing))) in.held.x[d] = 1;
  for (const auto& row : test::oracle_rows("hex_strip/u0.csv")) {
    in.initial.ux.push_back(std::stod(row[0]));
    in.initial.uy.push_back(std::stod(row[1]));
    in.initial.theta.push_back(std::stod(row[2]));
  }
  in.time_step = oracle.time_step;
  in.steps = 4000;
  in.sample_every = 10;
  for (const int d : {0, 310, 620, 315, 325, 31, 341, 651, 356, 371}) in.receivers.push_back({{d}});
  return in;
}

struct Errors {
  double displacement = 0.0, rotation = 0.0;  ///< max |difference| / max |value| over all rows
};

Errors compare(const Signals& s, const Oracle& oracle) {
  double du = 0, u = 0, dt = 0, t = 0;
  const auto rows = test::oracle_rows(oracle.file);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const std::size_t sample = k / 10, receiver = k % 10;
    const auto track = [](double ours, const std::string& text, double& error, double& size) {
      const double theirs = std::stod(text);
      error = std::max(error, std::abs(ours - theirs));
      size = std::max(size, std::abs(theirs));
    };
    track(s.ux[receiver].at(sample), rows[k][2], du, u);
    track(s.uy[receiver].at(sample), rows[k][3], du, u);
    if (rows[k].size() > 4) track(s.theta[receiver].at(sample), rows[k][4], dt, t);
  }
  return {du / u, t > 0 ? dt / t : 0.0};
}

Errors run(const Oracle& oracle, Kinematics kinematics, double stiffness_ratio, double step_factor = 1.0) {
  const Assembly a = strip();
  SimulationInput in = scene(a, oracle, kinematics);
  in.contact.stiffness_ratio = stiffness_ratio;
  in.time_step *= step_factor;
  return compare(simulate(a, in).signals, oracle);
}

TEST(OracleStrip, RightEdgeIsElevenDiscs) {
  EXPECT_EQ(edge_discs(strip().packing, Edge::right, 1.2 * 0.132e-3).size(), 11u);
}

class OracleStripKinematics : public testing::TestWithParam<Kinematics> {};
INSTANTIATE_TEST_SUITE_P(Both, OracleStripKinematics, testing::Values(Kinematics::linear, Kinematics::nonlinear));

// 1e-6: LAMMPS and Yade store positions, which quantises displacements of 1e-10 m in a strip of 1e-2 m; linear and
// nonlinear kinematics differ by 1.2e-7 at this amplitude.
TEST_P(OracleStripKinematics, Lammps) { EXPECT_LT(run(kLammps, GetParam(), 0.0).displacement, 1e-6); }

TEST_P(OracleStripKinematics, Yade) {
  const Errors e = run(kYade, GetParam(), 0.5);
  EXPECT_LT(e.displacement, 1e-6);
  EXPECT_LT(e.rotation, 1e-5);
}

// What these tolerances can see: each defect is at least ten times beyond them.
TEST(OracleStrip, SeesAWrongTimeStep) {
  EXPECT_GT(run(kLammps, Kinematics::linear, 0.0, 1.0 + 1e-4).displacement, 1e-5);
  const Errors e = run(kYade, Kinematics::linear, 0.5, 1.0 + 1e-4);
  EXPECT_GT(e.displacement, 1e-5);
  EXPECT_GT(e.rotation, 1e-4);
}

TEST(OracleStrip, SeesMissingRotations) {
  const Assembly a = strip();
  SimulationInput in = scene(a, kYade, Kinematics::linear);
  in.held.theta.assign(a.size(), 1);
  EXPECT_GT(compare(simulate(a, in).signals, kYade).displacement, 1e-5);
}

TEST(OracleStrip, SeesAWrongShearStiffness) {
  EXPECT_GT(run(kYade, Kinematics::linear, 0.5 * 1.001).displacement, 1e-5);
}

}  // namespace
}  // namespace ddem
