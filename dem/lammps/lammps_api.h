#pragma once
// What differs between the versions of LAMMPS that this compiles with, told apart by what compiles.

#include <lammps/comm.h>
#include <lammps/fix.h>

namespace ddem::lammps {

/// Values of owned discs to their ghosts, by pack_forward_comm() of the fix; `size` of them a disc.
template <class Comm>
void to_ghosts(Comm* comm, LAMMPS_NS::Fix* fix, int size) {
  if constexpr (requires { comm->forward_comm_fix(fix, size); }) {
    comm->forward_comm_fix(fix, size);
  } else {
    comm->forward_comm(fix, size);
  }
}

/// What ghosts were given is added to the discs that they are images of, by pack_reverse_comm().
template <class Comm>
void from_ghosts(Comm* comm, LAMMPS_NS::Fix* fix, int size) {
  if constexpr (requires { comm->reverse_comm_fix(fix, size); }) {
    comm->reverse_comm_fix(fix, size);
  } else {
    comm->reverse_comm(fix, size);
  }
}

}  // namespace ddem::lammps
