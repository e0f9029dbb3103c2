// LAMMPS absent, present (a script in its place, whose answers are known) and failing.

#include "harness/bench/peers.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "harness/io/atomic_file.h"
#include "harness/io/temporary_folder.h"

namespace ddem::harness::bench {
namespace {

/// An executable script.
std::string script(const TemporaryFolder& folder, const std::string& body) {
  const auto path = folder.path() / "lmp";
  write_file(path, "#!/bin/sh\n" + body);
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  return path.string();
}

const std::vector<PeerPlan> kPlans{{682, 40, 3}, {200, 10, 1}};

TEST(Peers, AbsentHasAReasonAndNoTimes) {
  int heard = 0;
  const Peers peers = time_peers(kPlans, [&] { ++heard; }, "no-such-program-as-lammps");
  EXPECT_EQ(heard, 2);
  EXPECT_TRUE(peers.times.empty());
  EXPECT_NE(peers.reason.find("not on the PATH"), std::string::npos);
  EXPECT_NE(peers.reason.find("apt-get install lammps"), std::string::npos);
}

TEST(Peers, PresentIsTimedByItsOwnWord) {
  const TemporaryFolder folder("ddem-peers-test");
  // Knows its version; writes the positions that it was given as its last.
  const std::string lmp = script(folder, R"(if [ "$1" = -h ]; then
  printf 'Large-scale Atomic/Molecular Massively Parallel Simulator - 1 Apr 2030\n'
  exit 0
fi
grep -q '^run 40$\|^run 10$' "$2" || exit 7
awk 'BEGIN { print "ITEM: ATOMS id x y" } /^Atoms/ { atoms = 1 } /^Bonds/ { atoms = 0 } atoms && NF == 6 { print $1, $4, $5 }' strip.data > end.txt
echo 'Loop time of 0.002 on 1 procs for 40 steps with 682 atoms'
)");
  const Peers peers = time_peers(kPlans, [] {}, lmp);
  EXPECT_EQ(peers.reason, "");
  ASSERT_EQ(peers.times.size(), 2u);
  const PeerTime& t = peers.times[0];
  EXPECT_EQ(t.program, "LAMMPS");
  EXPECT_EQ(t.version, "1 Apr 2030");
  EXPECT_EQ(t.discs, 682u);
  EXPECT_EQ(t.bonds, 1901u);  // 61 x 11 along the rows, 10 gaps of rows with 2 x 62 - 1 bonds
  EXPECT_NEAR(t.nanoseconds_per_bond_step, 0.002e9 / (1901.0 * 40.0), 1e-9);
  EXPECT_GT(t.ddem_nanoseconds_per_bond_step, 0.0);
  EXPECT_NEAR(t.ratio, t.nanoseconds_per_bond_step / t.ddem_nanoseconds_per_bond_step, 0.5 * t.ratio);  // of medians
  // It did not move; ddem did, within 40 steps of a tenth of the critical one, by a small part of a long wave.
  EXPECT_GT(t.difference, 1e-3);
  EXPECT_LT(t.difference, 1.0);
}

TEST(Peers, FailingIsAReason) {
  const TemporaryFolder folder("ddem-peers-test");
  const std::string lmp = script(folder, "[ \"$1\" = -h ] || echo 'ERROR: Unrecognized bond style' >&2\n[ \"$1\" = -h ]\n");
  const Peers peers = time_peers(kPlans, [] {}, lmp);
  EXPECT_TRUE(peers.times.empty());
  EXPECT_NE(peers.reason.find("exit code 1"), std::string::npos) << peers.reason;
  EXPECT_NE(peers.reason.find("Unrecognized bond style"), std::string::npos) << peers.reason;
}

}  // namespace
}  // namespace ddem::harness::bench
