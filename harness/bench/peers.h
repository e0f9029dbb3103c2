#pragma once
// Other programs on the same scene in the same run: LAMMPS (`lmp` on the PATH), harmonic bonds between the discs of a free
// lattice, which is the particle method without shear stiffness. Programs that are not installed are not compared.

#include <functional>
#include <string>
#include <vector>

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

struct PeerPlan {
  std::size_t discs = 0;
  long steps = 0;
  int rounds = 0;
};
std::vector<PeerPlan> peer_plans();

/// `program`: a path, or a name to be found on the PATH.
Peers time_peers(const std::vector<PeerPlan>& plans, const std::function<void()>& progress, const std::string& program = "lmp");

}  // namespace ddem::harness::bench
