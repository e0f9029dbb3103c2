// Other programs absent, present (scripts in their places, whose answers are known) and failing.

#include "harness/bench/peers.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "harness/io/atomic_file.h"
#include "harness/io/temporary_folder.h"

namespace ddem::harness::bench {
namespace {

const std::vector<PeerSize> kSizes{{682, 40, 3}, {200, 10, 1}};

PeerPlan lammps() { return {"LAMMPS", "harmonic bonds", false, "lmp", "lammps", lammps_solver, kSizes}; }
PeerPlan yade() { return {"Yade", "cohesive bonds", true, "yade", "yade", yade_solver, kSizes}; }

/// The peer, with an executable script in its place.
PeerPlan played_by(PeerPlan peer, const TemporaryFolder& folder, const std::string& body) {
  const auto path = folder.path() / peer.program;
  write_file(path, "#!/bin/sh\n" + body);
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  peer.program = path.string();
  return peer;
}

TEST(Peers, AbsentHasAReasonAndNoTimes) {
  int heard = 0;
  std::vector<PeerPlan> plans{lammps(), yade()};
  for (PeerPlan& plan : plans) plan.program = "no-such-program-as-" + plan.program;
  const Peers peers = time_peers(plans, [&] { ++heard; });
  EXPECT_EQ(heard, 4);
  EXPECT_TRUE(peers.times.empty());
  for (const char* program : {"no-such-program-as-lmp (LAMMPS) is not on the PATH", "no-such-program-as-yade (Yade) is not on the PATH",
                              "apt-get install lammps", "apt-get install yade"}) {
    EXPECT_NE(peers.reason.find(program), std::string::npos) << peers.reason;
  }
}

void expect_timed_but_unmoved(const PeerTime& t) {
  EXPECT_EQ(t.discs, 682u);
  EXPECT_EQ(t.bonds, 1901u);  // 61 x 11 along the rows, 10 gaps of rows with 2 x 62 - 1 bonds
  EXPECT_NEAR(t.nanoseconds_per_bond_step, 0.002e9 / (1901.0 * 40.0), 1e-9);
  EXPECT_GT(t.ddem_nanoseconds_per_bond_step, 0.0);
  EXPECT_NEAR(t.ratio, t.nanoseconds_per_bond_step / t.ddem_nanoseconds_per_bond_step, 0.5 * t.ratio);  // of medians
  EXPECT_NEAR(t.difference, 1.0, 1e-6);  // ddem moved
}

/// Knows its version; writes the positions that it was given as its last.
const char* const kPlaysLammps = R"(if [ "$1" = -h ]; then
  printf 'Large-scale Atomic/Molecular Massively Parallel Simulator - 1 Apr 2030\n'
  exit 0
fi
grep -q '^run 40$\|^run 10$' "$2" || exit 7
for frame in 0 1; do
  awk '/ atoms$/ { print "ITEM: NUMBER OF ATOMS"; print $1; print "ITEM: ATOMS id xu yu" }
       /^Atoms/ { atoms = 1 } /^Velocities/ { atoms = 0 } atoms && NF == 6 { print $1, $4, $5 }' strip.data
done > motion.txt
echo 'Loop time of 0.002 on 1 procs for 40 steps with 682 atoms'
)";
const char* const kPlaysYade = R"(if [ "$1" = --version ]; then
  echo 'Yade version: 2030.01 '
  exit 0
fi
grep -q '"steps": 40,\|"steps": 10,' strip.json || exit 7
test "$4" = strip.py || exit 8
yes '0 0 0' | head -n 2000 > motion.txt
echo 'Welcome to Yade'
echo 'Loop time 0.002 s'
)";

TEST(Peers, AreTimedByTheirOwnWord) {
  const TemporaryFolder folder("ddem-peers-test");
  const Peers peers = time_peers({played_by(lammps(), folder, kPlaysLammps), played_by(yade(), folder, kPlaysYade)}, [] {});
  EXPECT_EQ(peers.reason, "");
  ASSERT_EQ(peers.times.size(), 4u);
  EXPECT_EQ(peers.times[0].program, "LAMMPS");
  EXPECT_EQ(peers.times[0].version, "1 Apr 2030");
  EXPECT_EQ(peers.times[2].program, "Yade");
  EXPECT_EQ(peers.times[2].version, "2030.01");
  for (const int of_682_discs : {0, 2}) expect_timed_but_unmoved(peers.times[of_682_discs]);
}

TEST(Peers, FailingIsAReasonAndTheOthersAreTimed) {
  const TemporaryFolder folder("ddem-peers-test"), another("ddem-peers-test");
  const PeerPlan failing = played_by(lammps(), folder, "[ \"$1\" = -h ] || echo 'ERROR: Unrecognized bond style' >&2\n[ \"$1\" = -h ]\n");
  const PeerPlan vague = played_by(yade(), folder, "echo 'Loop time soon s'\n");
  const Peers peers = time_peers({failing, vague, played_by(yade(), another, kPlaysYade)}, [] {});
  for (const char* said : {"exit code 1", "Unrecognized bond style", "its time cannot be read"}) {
    EXPECT_NE(peers.reason.find(said), std::string::npos) << peers.reason;
  }
  ASSERT_EQ(peers.times.size(), 2u);
  expect_timed_but_unmoved(peers.times[0]);
}

/// Real ones, where they are installed: the same motion, so that what is timed is the same work.
TEST(Peers, InstalledOnesMoveAlike) {
  std::vector<PeerPlan> plans{lammps(), yade()};
  for (PeerPlan& plan : plans) plan.sizes = {{682, 400, 1}};
  const Peers peers = time_peers(plans, [] {});
  for (const PeerTime& t : peers.times) EXPECT_LT(t.difference, 1e-5) << t.program;
  if (peers.times.empty()) GTEST_SKIP() << peers.reason;
}

}  // namespace
}  // namespace ddem::harness::bench
