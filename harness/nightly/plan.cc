#include "harness/nightly/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "harness/io/atomic_file.h"
#include "harness/io/digest.h"
#include "harness/io/errors.h"
#include "harness/io/regular_file.h"
#include "harness/nightly/unit_file.h"

namespace ddem::harness::nightly {
namespace {

std::filesystem::path plan_path(const std::filesystem::path& folder) {
  return folder / "plan.json";
}

Json content_of(const Plan& plan) {
  Json units = Json::array();
  for (const Plan::Entry& u : plan.units) units.push_back({{"id", u.id}, {"identity", u.identity}});
  return {{"schema_version", 1}, {"program", plan.program}, {"campaign", plan.campaign}, {"units", units}};
}

}  // namespace

std::string Plan::digest() const {
  return sha256(to_text(content_of(*this)));
}

Plan make_plan(std::span<const Unit> units, Json campaign, const std::string& program) {
  Plan plan{program, std::move(campaign), {}};
  std::set<std::string> ids;
  for (const Unit& u : units) {
    if (!ids.insert(u.id).second) throw std::logic_error("two units of the campaign are called " + u.id);
    plan.units.push_back({u.id, identity_of(u, program)});
  }
  return plan;
}

void write_plan(const std::filesystem::path& folder, const Plan& plan) {
  Json j = content_of(plan);
  if (!plan.source.empty()) j["source"] = plan.source;
  write_json(plan_path(folder), sealed(j));
  std::error_code ignored;  // a file system without permissions
  using std::filesystem::perms;
  std::filesystem::permissions(plan_path(folder), perms::owner_write | perms::group_write | perms::others_write,
                               std::filesystem::perm_options::remove, ignored);
}

bool has_plan(const std::filesystem::path& folder) {
  std::error_code ignored;
  return std::filesystem::exists(plan_path(folder), ignored);
}

Plan read_plan(const std::filesystem::path& folder) {
  const std::string path = plan_path(folder).string();
  if (!has_plan(folder))
    throw InputError(
        path + ": there is no such file; is this the folder of a campaign, as ddem validate -o makes it?");
  Json j = parse_json(read_regular_file(path), path);
  try {
    if (!j.contains("digest")) throw InputError(path + ": not a plan, as ddem validate -o writes it: its digest is missing");
    j = unsealed(std::move(j), path);
    require_schema_version(j, path);
    Plan plan{j.at("program"), j.at("campaign"), {}, j.value("source", "")};
    for (const Json& u : j.at("units")) plan.units.push_back({u.at("id"), u.at("identity")});
    return plan;
  } catch (const Json::exception& e) {
    throw InputError(path + ": not a plan, as ddem validate -o writes it: " + in_words(e));
  }
}

bool holds_plan(const std::filesystem::path& folder, const Plan& plan) {
  try {
    return has_plan(folder) && difference(read_plan(folder), plan).empty();
  } catch (const InputError&) {  // damaged
    return false;
  }
}

std::string difference(const Plan& there, const Plan& here) {
  if (there.digest() == here.digest()) return "";
  if (there.program != here.program)
    return fmt::format("made by another program, {}, not {}", there.program, here.program);
  const auto lacks = [](const Plan& plan, const Plan::Entry& unit) {
    return std::find(plan.units.begin(), plan.units.end(), unit) == plan.units.end();
  };
  for (const Plan::Entry& u : there.units) {
    if (lacks(here, u))
      return fmt::format("it has {} units, not {}; {} is among those that differ", there.units.size(),
                         here.units.size(), u.id);
  }
  return fmt::format("it has {} units, not {}, or another title or order", there.units.size(),
                     here.units.size());
}

}  // namespace ddem::harness::nightly
