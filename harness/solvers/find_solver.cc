#include "harness/solvers/find_solver.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>

#include "harness/io/errors.h"
#include "harness/scene/nearest_name.h"
#include "harness/scene/violation.h"
#include "harness/solvers/ready.h"

namespace ddem::harness {

std::shared_ptr<const Solver> find_solver(const std::string& name, std::optional<int> ranks) {
  if (name == builtin_solver().name() && ranks) throw InputError("--ranks: the built-in solver has none; run.threads of the scene are its threads");
  if (name == builtin_solver().name()) return {std::shared_ptr<void>(), &builtin_solver()};
  std::error_code ignored;
  if (name.ends_with(".toml") || std::filesystem::exists(name, ignored)) {
    SolverDescription description = read_solver_description(name);
    if (ranks) description.ranks = *ranks;
    return external_solver(std::move(description));
  }
  if (name == "lammps") return lammps_solver({"", ranks.value_or(1)});
  if (name == "lammps-ddem") return lammps_ddem_solver({"", ranks.value_or(1)});
  if (name == "yade") {
    if (ranks) throw InputError("--ranks: yade has none");
    return yade_solver();
  }
  constexpr std::array<std::string_view, 4> kNames{"builtin", "lammps", "lammps-ddem", "yade"};
  const auto near = nearest_name(name, kNames);
  throw InputError(fmt::format("--solver {}: there is no such solver; {}", printable(name, 200),
                               near ? fmt::format("did you mean {}?", *near) : "give builtin, lammps, lammps-ddem, yade, or a file that describes a program (see harness/guide/solvers.md)"));
}

std::vector<std::string> installed_solvers() {
  std::vector<std::string> found;
  for (const char* name : {"lammps", "lammps-ddem", "yade"}) {
    try {
      find_solver(name);
      found.emplace_back(name);
    } catch (const MachineError&) {  // not here
    }
  }
  return found;
}

}  // namespace ddem::harness
