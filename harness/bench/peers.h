#pragma once
// Other programs on the same scene in the same run, in turns with ddem. Programs that are not installed are not compared.

#include <functional>
#include <string>
#include <vector>

#include "harness/solvers/ready.h"

namespace ddem::harness::bench {

struct PeerTime {
  std::string program, version, law;
  std::size_t discs = 0, bonds = 0;
  long steps = 0;
  double nanoseconds_per_bond_step = 0.0;       ///< the program's own time of its loop, median of the rounds
  double ddem_nanoseconds_per_bond_step = 0.0;  ///< in turns with it
  double ratio = 0.0;                           ///< median over the rounds: the program's time over that of ddem
  double difference = 0.0;  ///< of the last displacements, over their largest: both must have moved alike
};

struct Peers {
  std::vector<PeerTime> times;
  std::string reason;  ///< why there are none, or not all
};

struct PeerSize {
  std::size_t discs = 0;
  long steps = 0;
  int rounds = 0;
};

struct PeerPlan {
  std::string name, law;
  bool shear = false;            ///< with shear stiffness and rotations
  std::string program, package;  ///< on the PATH, or a path; of Debian
  std::shared_ptr<const Solver> (*solver)(const ReadyOptions&) = nullptr;
  std::vector<PeerSize> sizes;
};

/// LAMMPS and Yade with 682, 1e5 and 1e6 discs.
std::vector<PeerPlan> peer_plans();

/// `progress` is called once for each size of each peer, installed or not.
Peers time_peers(const std::vector<PeerPlan>& plans, const std::function<void()>& progress);

}  // namespace ddem::harness::bench
