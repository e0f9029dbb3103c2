// [[case]] as an input of campaigns.
#include <fmt/format.h>

#include <algorithm>

#include "harness/io/data_json.h"
#include "harness/io/errors.h"
#include "harness/studies/user_cases/read_cases.h"

namespace ddem::harness {
namespace {

using nlohmann::json;

const json& member(const json& j, const char* name) {
  static const json none;
  const auto found = j.find(name);
  return j.is_object() && found != j.end() ? *found : none;
}

}  // namespace

json read_case_table(const Document& file, const std::filesystem::path& path, std::vector<std::string>& problems) {
  return read_cases(file, path, problems);
}

void check_cases(const json& data) {
  for (const UserCase& c : data.get<std::vector<UserCase>>()) {
    for (const CaseCriterion& criterion : c.criteria) {
      if (!group_of(criterion.metric) || !group_of(criterion.reference)) throw InputError("plan.json: " + c.id + ": an unknown metric");
    }
  }
}

std::string lost_of_cases(const json& there, const json& here) {
  for (const json& before : there) {
    const json& id = member(before, "id");
    const auto now = std::find_if(here.begin(), here.end(), [&](const json& c) { return member(c, "id") == id; });
    const std::string name = id.is_string() ? "case/" + id.get<std::string>() : "a case without a name";
    if (now == here.end()) return fmt::format("{}, which this run has not", name);
    for (const char* part : {"text", "overrides"}) {
      if (member(before, part) != member(*now, part)) return fmt::format("{} of another scene than this run's", name);
    }
  }
  return "";
}

void introduce_cases(const json& data, reports::Report& report) {
  if (!report.title.empty()) return;  // beside the strip
  report.title = data.size() == 1 ? data.front().at("title").get<std::string>() : fmt::format("Campaign of {} cases", data.size());
}

}  // namespace ddem::harness
