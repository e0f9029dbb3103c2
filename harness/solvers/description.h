#pragma once
// A program that simulates, described by a file: how it is called, and what it can do. See harness/guide/solvers.md.

#include <filesystem>
#include <string>
#include <vector>

#include "harness/solvers/solver.h"

namespace ddem::harness {

struct SolverDescription {
  std::string name;
  std::vector<std::string> command;          ///< program and arguments; {folder} and {ranks} are replaced
  std::vector<std::string> version_command;  ///< likewise, without a folder; its first line of output is the version; empty: none
  double time_limit = 3600.0;                ///< of a run, s
  int ranks = 1;
  std::vector<std::filesystem::path> may_write;  ///< besides the folder of the run
  /// Without a word of the description: all but nonlinear kinematics and new contacts.
  Abilities abilities{.laws = {}, .exact_in_time = false, .nonlinear = false, .new_contacts = false, .periodic = true, .held_discs = true, .driven_edge = true,
                      .energies = false, .snapshots = false};
  std::filesystem::path path;  ///< of the file
  std::string text;            ///< the file itself
};

/// Files that the commands name are looked for beside the description, too. Throws InputError, with every problem.
SolverDescription read_solver_description(const std::filesystem::path& path);
/// The same of a text that stands for the file.
SolverDescription parse_solver_description(const std::string& text, const std::filesystem::path& path);

}  // namespace ddem::harness
