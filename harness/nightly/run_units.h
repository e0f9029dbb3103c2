#pragma once
// Runs the units of a plan, keeps what they found, and goes on where an interrupted run left off.

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harness/nightly/plan.h"
#include "harness/nightly/supervise.h"
#include "harness/nightly/unit.h"

namespace ddem::harness::nightly {

/// Unit k of a plan belongs to shard k mod count + 1.
struct Shard {
  std::size_t index = 1, count = 1;
  bool has(std::size_t k) const { return k % count == index - 1; }
  std::size_t size(std::size_t units) const { return units / count + (units % count >= index ? 1 : 0); }
};

/// "2/8". Throws InputError.
Shard parse_shard(const std::string& text);

struct RunOptions {
  std::filesystem::path folder = {};  ///< where outcomes are kept; empty: nowhere
  int jobs = 1;
  Shard shard = {};
  bool resume = false;  ///< results in the folder that are whole, of the same identity and no failures are
                        ///< not made again
  std::vector<std::size_t> given_up = {};  ///< units whose outcome in the folder stands, failure or not
  UnitBoard* board = nullptr;              ///< hears what is running
  /// Called from any thread with the work done.
  std::function<void(std::size_t)> on_progress = {};
};

/// Called once a unit of the shard, one at a time, in any order.
using OnOutcome = std::function<void(std::size_t unit, const Outcome&)>;

/// Throws InputError where the units that take most memory, as many as run at a time, take more of it than there is: `available`
/// bytes. What is kept in the folder is not run.
void require_memory_of_jobs(std::span<const Unit> units, const Plan& plan, const RunOptions& options, double available);

/// Units that fail are outcomes. Throws InputError where they would take too much memory at a time, before any runs; MachineError
/// where one cannot be written: what is on the disk by then stays.
void run_units(std::span<const Unit> units, const Plan& plan, const RunOptions& options,
               const OnOutcome& on_outcome);

/// The outcomes of a folder, those of whole files that belong to the plan; why the others do not, as
/// failures.
void read_outcomes(const std::filesystem::path& folder, const Plan& plan, const OnOutcome& on_outcome);

}  // namespace ddem::harness::nightly
