#pragma once
// Programs that ddem knows how to call. A new one is a file, and a line in find_solver.cc.

#include <memory>
#include <string>
#include <vector>

#include "harness/solvers/external.h"

namespace ddem::harness {

struct ReadyOptions {
  std::string program;  ///< empty: as Debian calls it, on the PATH
  int ranks = 1;
};

/// What starts a program on that many ranks: nothing for one; srun within a job of Slurm, so that it gets the nodes of the job;
/// else mpirun.
std::vector<std::string> launcher(int ranks);

std::shared_ptr<const Solver> lammps_solver(const ReadyOptions& options = {});
/// DDEM on LAMMPS (dem/lammps); without a name the program beside this one.
std::shared_ptr<const Solver> lammps_ddem_solver(const ReadyOptions& options = {});
std::shared_ptr<const Solver> yade_solver(const ReadyOptions& options = {});

}  // namespace ddem::harness
