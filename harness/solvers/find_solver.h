#pragma once
// Solvers by name.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/solvers/solver.h"

namespace ddem::harness {

/// What --help says of the option.
inline constexpr const char* kSolverHelp = "who simulates: builtin, lammps, lammps-ddem, yade, or a file that describes a program (TOML, see harness/guide/solvers.md)";

inline constexpr const char* kRanksHelp = "with --solver: its ranks, {ranks} in the command of its description";

/// `ranks`: those that were asked for. "builtin", "lammps", "lammps-ddem", "yade", or the path of a description. Throws InputError for what is neither, and as external_solver().
std::shared_ptr<const Solver> find_solver(const std::string& name, std::optional<int> ranks = {});

/// Of those that need no description: whose programs are on the PATH.
std::vector<std::string> installed_solvers();

}  // namespace ddem::harness
