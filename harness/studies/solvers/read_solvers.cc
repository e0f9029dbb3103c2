#include "harness/studies/solvers/read_solvers.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "harness/io/errors.h"
#include "harness/scene/violation.h"
#include "harness/solvers/find_solver.h"

namespace ddem::harness {
namespace {

constexpr const char* kRemedy = "give names = [\"lammps\", \"my-dem.toml\"], or names = \"installed\"";

std::vector<std::string> names_of(const Node& node) {
  if (const auto* text = std::get_if<std::string>(&node.value); text != nullptr && *text == "installed") return installed_solvers();
  std::vector<std::string> names;
  const auto* list = std::get_if<Node::List>(&node.value);
  if (list == nullptr) return names;
  for (const Node& item : *list) {
    const auto* name = std::get_if<std::string>(&item.value);
    if (name == nullptr || name->empty()) return {};
    names.push_back(*name);
  }
  return names;
}

/// A description is looked for beside the campaign's file.
std::string beside(const std::string& name, const std::filesystem::path& campaign) {
  if (!name.ends_with(".toml") || std::filesystem::path(name).is_absolute()) return name;
  return (campaign.parent_path() / name).lexically_normal().string();
}

}  // namespace

std::string label_of_solver(const std::string& name) {
  std::string label = name.ends_with(".toml") ? std::filesystem::path(name).stem().string() : name;
  std::ranges::replace_if(label, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '_' && c != '.'; }, '-');
  return label;
}

nlohmann::json read_solvers(const Document& file, const std::filesystem::path& path, std::vector<std::string>& problems) {
  std::vector<std::string> names;
  const auto report = [&](int line, const std::string& key, const std::string& value, const std::string& message, const std::string& remedy) {
    problems.push_back(to_string(Violation{path.string(), line, 0, key, value, message, remedy}));
  };
  bool given = false;
  for (const Entry& e : file.entries) {
    if (e.table != "solvers") continue;
    if (e.key != "names") {
      report(e.node.line, "solvers." + e.key, e.node.text, "unknown key", "the key is names");
      continue;
    }
    given = true;
    std::set<std::string> labels;
    for (const std::string& name : names_of(e.node)) {
      names.push_back(beside(name, path));
      if (!labels.insert(label_of_solver(name)).second) report(e.node.line, "solvers.names", name, "two solvers would be called alike", "call one of the files otherwise");
    }
    if (names.empty()) report(e.node.line, "solvers.names", e.node.text, "no solvers", kRemedy);
  }
  if (!given) report(0, "solvers.names", "", "is missing", kRemedy);
  return {{"names", names}};
}

void check_solvers(const nlohmann::json& data) {
  if (data.at("names").get<std::vector<std::string>>().empty()) throw InputError("solvers: no names");
}

std::string lost_of_solvers(const nlohmann::json& there, const nlohmann::json& here) {
  for (const nlohmann::json& name : there.value("names", nlohmann::json::array())) {
    const nlohmann::json now = here.is_object() ? here.value("names", nlohmann::json::array()) : nlohmann::json::array();
    if (std::find(now.begin(), now.end(), name) == now.end()) return fmt::format("the solver {}, which this run has not", name.dump());
  }
  return "";
}

void introduce_solvers(const nlohmann::json& data, reports::Report& report) {
  if (!report.title.empty()) return;  // beside the strip
  std::vector<std::string> labels;
  for (const std::string& name : data.at("names").get<std::vector<std::string>>()) labels.push_back(label_of_solver(name));
  report.title = fmt::format("Solvers: {}", fmt::join(labels, ", "));
}

}  // namespace ddem::harness
