#include "harness/nightly/run_units.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <functional>
#include <mutex>

#include "harness/io/errors.h"
#include "harness/io/memory.h"
#include "harness/nightly/unit_file.h"
#include "harness/nightly/worker_pool.h"

namespace ddem::harness::nightly {
namespace {

/// A result that need not be made again.
std::optional<Outcome> kept_outcome(const RunOptions& options, const Plan::Entry& planned, std::size_t unit) {
  const bool given_up =
      std::find(options.given_up.begin(), options.given_up.end(), unit) != options.given_up.end();
  if ((!options.resume && !given_up) || options.folder.empty()) return std::nullopt;
  try {
    UnitRecord r = read_unit(options.folder, planned.id, planned.identity);
    if (given_up || r.outcome.failure.empty()) return std::move(r.outcome);
  } catch (const InputError&) {  // missing, damaged or of other inputs: made again
  }
  return std::nullopt;
}

bool take_number(std::string_view& text, std::size_t& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{}) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

std::vector<std::size_t> units_of(const Shard& shard, std::size_t units) {
  std::vector<std::size_t> mine;
  for (std::size_t k = 0; k < units; ++k) {
    if (shard.has(k)) mine.push_back(k);
  }
  return mine;
}

}  // namespace

Shard parse_shard(const std::string& text) {
  Shard shard;
  std::string_view rest = text;
  const bool whole = take_number(rest, shard.index) && rest.starts_with('/') &&
                     (rest.remove_prefix(1), take_number(rest, shard.count)) && rest.empty();
  if (!whole || shard.index < 1 || shard.index > shard.count || shard.count > 100000) {
    throw InputError("--shard " + text + ": give i/n with 1 <= i <= n <= 100000, such as 2/8");
  }
  return shard;
}

void require_memory_of_jobs(std::span<const Unit> units, const Plan& plan, const RunOptions& options, double available) {
  std::vector<double> bytes;
  for (const std::size_t k : units_of(options.shard, units.size())) {
    if (units[k].memory > 0.0 && !kept_outcome(options, plan.units[k], k)) bytes.push_back(units[k].memory);
  }
  std::ranges::sort(bytes, std::greater<>());
  const std::size_t jobs = std::min(bytes.size(), static_cast<std::size_t>(std::max(1, options.jobs)));
  double sum = 0.0;
  std::size_t fit = 0;
  for (std::size_t n = 0; n < jobs; ++n) {
    sum += bytes[n];
    if (sum <= available) fit = n + 1;
  }
  // One alone is refused by itself, with its key.
  if (jobs < 2 || sum <= available) return;
  throw InputError(fmt::format("--jobs: {} of the campaign's simulations at a time would take {} of memory, and {} are left; take {}", jobs, bytes_text(sum),
                               bytes_text(available), fit > 0 ? fmt::format("--jobs {}", fit) : "smaller ones, or a machine with more memory"));
}

void run_units(std::span<const Unit> units, const Plan& plan, const RunOptions& options,
               const OnOutcome& on_outcome) {
  const std::vector<std::size_t> mine = units_of(options.shard, units.size());
  require_memory_of_jobs(units, plan, options, available_memory());
  std::mutex outcome_mutex;
  run_jobs(mine.size(), options.jobs, [&](std::size_t job) {
    const std::size_t k = mine[job];
    std::optional<Outcome> outcome = kept_outcome(options, plan.units[k], k);
    const bool kept = outcome.has_value();
    if (!kept) {
      if (options.board != nullptr) options.board->set_running(k, true);
      UnitRecord record{plan.units[k].id, plan.units[k].identity, run_unit(units[k])};
      if (options.board != nullptr) options.board->set_running(k, false);
      if (!options.folder.empty()) write_unit(options.folder, record);
      outcome = std::move(record.outcome);
    }
    {
      const std::lock_guard lock(outcome_mutex);
      on_outcome(k, *outcome);
    }
    if (options.on_progress && (kept || !units[k].reports_progress)) options.on_progress(units[k].work);
  });
}

void read_outcomes(const std::filesystem::path& folder, const Plan& plan, const OnOutcome& on_outcome) {
  for (std::size_t k = 0; k < plan.units.size(); ++k) {
    Outcome outcome;
    try {
      outcome = read_unit(folder, plan.units[k].id, plan.units[k].identity).outcome;
    } catch (const InputError& e) {
      outcome.failure = std::string("no result: ") + e.what();
    }
    on_outcome(k, outcome);
  }
}

}  // namespace ddem::harness::nightly
