#include "harness/nightly/merge.h"

#include <fmt/format.h>

#include <map>
#include <optional>

#include "harness/io/digest.h"
#include "harness/io/errors.h"
#include "harness/nightly/unit_file.h"

namespace ddem::harness::nightly {
namespace {

namespace fs = std::filesystem;

struct Candidate {
  fs::path folder;
  bool failed = false;
  std::string content, bytes;  ///< digests: without times, and of all

  /// Results before failures; then in an order that does not depend on the folders'.
  bool precedes(const Candidate& other) const {
    return std::tie(failed, bytes) < std::tie(other.failed, other.bytes);
  }
};

Plan common_plan(std::span<const fs::path> folders) {
  Plan plan = read_plan(folders.front());
  std::vector<std::string> problems;
  for (const fs::path& folder : folders.subspan(1)) {
    if (const std::string d = difference(read_plan(folder), plan); !d.empty()) {
      problems.push_back(
          fmt::format("{}: of another plan than {}: {}", folder.string(), folders.front().string(), d));
    }
  }
  if (!problems.empty()) throw InputError(problems);
  return plan;
}

/// The one to be kept. `conflicts` gets a line where two results differ.
std::optional<Candidate> choose(std::span<const fs::path> folders, const Plan::Entry& unit,
                                std::vector<std::string>& refused, std::vector<std::string>& conflicts) {
  std::optional<Candidate> best;
  for (const fs::path& folder : folders) {
    std::error_code ignored;
    if (!fs::exists(unit_path(folder, unit.id), ignored)) continue;
    Candidate c{folder, false, "", ""};
    try {
      const UnitRecord r = read_unit(folder, unit.id, unit.identity);
      c.failed = !r.outcome.failure.empty();
      c.content = content_digest(r);
      c.bytes = sha256(to_bytes(r));
    } catch (const InputError& e) {
      refused.push_back(e.what());
      continue;
    }
    if (best && !best->failed && !c.failed && best->content != c.content) {
      conflicts.push_back(fmt::format("{}: {} and {} have different results of the same inputs and program",
                                      unit.id, best->folder.string(), folder.string()));
    }
    if (!best || c.precedes(*best)) best = std::move(c);
  }
  return best;
}

}  // namespace

MergeReport merge_folders(std::span<const fs::path> from, const fs::path& target, bool replace) {
  std::vector<fs::path> folders(from.begin(), from.end());
  if (has_plan(target) && (!replace || holds_plan(target, read_plan(folders.front())))) folders.push_back(target);
  const Plan plan = common_plan(folders);
  MergeReport report;
  std::vector<std::string> conflicts;
  std::map<std::string, Candidate> chosen;
  for (const Plan::Entry& unit : plan.units) {
    if (auto best = choose(folders, unit, report.refused, conflicts))
      chosen.emplace(unit.id, std::move(*best));
    else
      report.missing.push_back(unit.id);
  }
  if (!conflicts.empty()) throw InputError(conflicts);
  write_plan(target, plan);
  for (const Plan::Entry& unit : plan.units) {
    if (const auto found = chosen.find(unit.id); found != chosen.end())
      write_unit(target, read_unit(found->second.folder, unit.id, unit.identity));
  }
  return report;
}

}  // namespace ddem::harness::nightly
