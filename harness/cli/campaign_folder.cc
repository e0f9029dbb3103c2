#include "harness/cli/campaign_folder.h"

#include <fmt/format.h>

#include <map>

#include "harness/campaign/campaign_spec.h"
#include "harness/campaign/report_file.h"
#include "harness/io/errors.h"
#include "harness/nightly/summary.h"

namespace ddem::harness {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRemedy = "give another folder by -o, or --force to replace it";

bool has_file(const fs::path& folder, const char* name) {
  std::error_code ignored;
  return fs::exists(folder / name, ignored);
}

/// "", or its title and how many cases it has.
std::string description(const fs::path& folder) {
  try {
    const nightly::Summary summary = nightly::read_summary(folder);
    return fmt::format(" (\"{}\", {} cases)", summary.title, summary.verdicts.size());
  } catch (const InputError&) {  // none, or damaged
    return "";
  }
}

std::string lost(const fs::path& folder, const nightly::Plan& plan) {
  if (nightly::has_plan(folder)) {
    try {
      return lost_of_campaign(nightly::read_plan(folder).campaign, plan.campaign);
    } catch (const InputError& e) {
      return fmt::format("nobody knows which, {}", e.what());
    }
  }
  for (const char* file : {"report.html", "summary.json", "results.h5", "junit.xml"}) {
    if (has_file(folder, file)) return fmt::format("{}, without a plan.json that says which", file);
  }
  return "";
}

/// With a slash at its end, also where it does not exist yet.
std::string real(const fs::path& p) {
  return (fs::weakly_canonical(fs::absolute(p)) / "").lexically_normal().string();
}

}  // namespace

void check_replaceable(const fs::path& folder, const nightly::Plan& plan, bool force) {
  if (force) return;
  if (const std::string l = lost(folder, plan); !l.empty())
    throw InputError(fmt::format("{}: holds another campaign{}: {}; {}", folder.string(), description(folder), l, kRemedy));
}

void check_drawable(const fs::path& folder, const reports::Report& report, bool force) {
  if (force || !has_file(folder, "report.html") || drawn_campaign(folder) == campaign_mark(report)) return;
  throw InputError(fmt::format("{}: holds the report of another campaign{}; {}", folder.string(), description(folder), kRemedy));
}

void require_apart(const std::filesystem::path& folder, const std::filesystem::path& history) {
  if (history.empty()) return;
  const std::string run = real(folder), nights = real(history);
  if (run.starts_with(nights) || nights.starts_with(run)) {
    throw InputError(fmt::format("--history {}: is the folder of the results ({}), or one lies in the other; give the nights a folder of their own",
                                 history.string(), folder.string()));
  }
}

void require_distinct(const std::vector<std::string>& folders, const fs::path& target) {
  std::vector<std::string> problems;
  std::map<std::string, std::string> taken;  // by what they are: how they were called
  for (const std::string& folder : folders) {
    if (const auto [other, is_new] = taken.emplace(real(folder), folder); !is_new)
      problems.push_back(fmt::format("{}: is given twice{}; give each folder once", folder, other->second == folder ? "" : ", first as " + other->second));
  }
  if (taken.contains(real(target)))
    problems.push_back(fmt::format("-o {}: is one of the folders to be merged; give what they make together a folder of its own", target.string()));
  if (!problems.empty()) throw InputError(problems);
}

}  // namespace ddem::harness
