#pragma once
// Any program as a solver: it is given a folder (exchange.h), and leaves signals.csv there.

#include <functional>
#include <memory>
#include <string>

#include "harness/solvers/description.h"
#include "harness/solvers/exchange.h"

namespace ddem::harness {

/// What stands between a program that does not know the exchange, and us.
struct Translation {
  std::function<void(const std::filesystem::path& folder, const Exchange&)> write;  ///< its input
  /// What it left, and what it printed, as signals and wall seconds. Throws InputError where that cannot be read.
  std::function<SimulationResult(const std::filesystem::path& folder, const Exchange&, const std::string& printed)> read;
  std::function<std::string(const std::string& printed)> version;  ///< from the output of the version command
  /// What it cannot do, besides the description's abilities; empty: nothing.
  std::function<std::string(const ddem::Assembly&, const SimulationInput&)> refusal;
};

/// Asks the program for its version. Throws MachineError where it cannot be started or fails.
std::shared_ptr<const Solver> external_solver(SolverDescription description, Translation translation = {});

/// What stands in a text between two marks; empty where they are not there.
std::string_view between(std::string_view text, std::string_view before, std::string_view after);
/// The finite number that stands between two marks of what a program printed. Throws InputError.
double number_between(const std::string& printed, std::string_view before, std::string_view after);

}  // namespace ddem::harness
