#include "harness/nightly/summary.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "harness/io/errors.h"

namespace ddem::harness::nightly {
namespace {

Json criterion_json(const reports::Criterion& c) {
  Json j{{"metric", c.metric}, {"actual", number_or_status(c.actual, "not measured")}};
  // A criterion without a target or bound has no such key.
  if (std::isfinite(c.target)) j["target"] = c.target;
  if (std::isfinite(c.lower)) j["lower"] = c.lower;
  if (std::isfinite(c.upper)) j["upper"] = c.upper;
  j["unit"] = c.unit;
  j["derivation"] = c.derivation;
  j["state"] = reports::to_string(c.state);
  return j;
}

reports::State state_of(const std::string& text) {
  const auto* found =
      std::find_if(std::begin(reports::kStatesWorstFirst), std::end(reports::kStatesWorstFirst),
                   [&](reports::State s) { return reports::to_string(s) == text; });
  if (found == std::end(reports::kStatesWorstFirst)) throw InputError("unknown state " + text);
  return *found;
}

reports::Criterion parse_criterion(const Json& j) {
  reports::Criterion c;
  c.metric = j.at("metric");
  if (j.at("actual").is_number()) c.actual = j.at("actual");
  c.target = j.value("target", c.target);
  c.lower = j.value("lower", c.lower);
  c.upper = j.value("upper", c.upper);
  c.unit = j.at("unit");
  c.derivation = j.at("derivation");
  c.state = state_of(j.at("state"));
  // What was not measured did not pass, whatever the file says.
  if (!std::isfinite(c.actual) && c.state != reports::State::missing) c.state = reports::State::error;
  return c;
}

}  // namespace

Json summary_json(const Summary& s) {
  Json provenance = Json::object();
  for (const auto& [key, value] : s.provenance) provenance[key] = value;
  Json j{{"schema_version", 1},
         {"title", s.title},
         {"provenance", provenance},
         {"wall_seconds", s.wall_seconds},
         {"cases", Json::array()}};
  for (const reports::Verdict& v : s.verdicts) {
    Json c{{"id", v.case_id},    {"title", v.title},         {"state", reports::to_string(v.state)},
           {"reason", v.reason}, {"reproduce", v.reproduce}, {"criteria", Json::array()}};
    for (const reports::Criterion& criterion : v.criteria) c["criteria"].push_back(criterion_json(criterion));
    j["cases"].push_back(c);
  }
  return j;
}

Summary parse_summary(const Json& j, const std::string& place) {
  require_schema_version(j, place);
  try {
    Summary s;
    s.title = j.at("title");
    s.wall_seconds = j.at("wall_seconds");
    for (const auto& [key, value] : j.at("provenance").items()) s.provenance.emplace_back(key, value);
    for (const Json& c : j.at("cases")) {
      reports::Verdict v{.case_id = c.at("id"),
                         .title = c.at("title"),
                         .state = state_of(c.at("state")),
                         .reason = c.at("reason"),
                         .criteria = {},
                         .reproduce = c.at("reproduce")};
      for (const Json& criterion : c.at("criteria")) v.criteria.push_back(parse_criterion(criterion));
      s.verdicts.push_back(std::move(v));
    }
    return s;
  } catch (const Json::exception& e) {
    throw InputError(place + ": not the summary of a campaign: " + in_words(e));
  } catch (const InputError& e) {
    throw InputError(place + ": not the summary of a campaign: " + e.what());
  }
}

Summary read_summary(const std::filesystem::path& folder) {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(folder, ignored))
    throw InputError(folder.string() + ": a file; give the folder of a run, as ddem validate -o makes it");
  const std::filesystem::path path = folder / "summary.json";
  return parse_summary(read_json(path), path.string());
}

}  // namespace ddem::harness::nightly
