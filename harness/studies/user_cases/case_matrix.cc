#include "harness/studies/user_cases/case_matrix.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "harness/io/json.h"
#include "harness/scene/keys.h"
#include "harness/scene/nearest_name.h"

namespace ddem::harness {
namespace {

/// Empty: no single value.
std::string toml_text(const Node& node) {
  if (const auto* b = std::get_if<bool>(&node.value)) return *b ? "true" : "false";
  if (const auto* i = std::get_if<std::int64_t>(&node.value)) return fmt::format("{}", *i);
  if (const auto* d = std::get_if<double>(&node.value)) return fmt::format("{}", *d);
  if (const auto* s = std::get_if<std::string>(&node.value)) return Json(*s).dump();
  return "";
}

bool is_scene_key(const Entry& e, const ReportProblem& report) {
  const bool dotted = e.key.find('.') != std::string::npos;
  if (dotted && find_key(e.key)) return true;
  std::vector<std::string> names;
  for (const KeySpec& spec : scene_keys()) names.push_back(dotted_name(spec.table, spec.key));
  const auto near = nearest_name(e.key, std::vector<std::string_view>(names.begin(), names.end()));
  report(e.node.line, "case.matrix." + e.key, e.node.text, dotted ? "unknown key" : "no key of a scene",
         dotted && near ? fmt::format("did you mean \"{}\"?", *near)
                        : "name a key of scenes with its table, in quotes, such as \"contact.stiffness_ratio\"; ddem scene-reference lists them");
  return false;
}

/// Values that are alike as a part of a name are told apart by a number.
void add_names(MatrixAxis& axis) {
  std::map<std::string, int> uses;
  for (const std::string& value : axis.values) {
    const std::string name = plain_name(axis.key.substr(axis.key.rfind('.') + 1) + "=" + value);
    const int use = ++uses[name];
    axis.names.push_back(use == 1 ? name : fmt::format("{}~{}", name, use));
  }
}

/// Its values; empty where the entry is no list of them.
std::vector<std::string> values_of(const Entry& e) {
  std::vector<std::string> values;
  if (const auto* list = std::get_if<Node::List>(&e.node.value)) {
    for (const Node& item : *list) values.push_back(toml_text(item));
  }
  if (std::find(values.begin(), values.end(), "") != values.end()) values.clear();
  return values;
}

}  // namespace

std::string plain_name(std::string text) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || std::string_view("-_.+=").find(c) != std::string_view::npos;
  };
  std::erase(text, '"');
  std::replace_if(text.begin(), text.end(), [&](char c) { return !plain(c); }, '-');
  return text;
}

std::vector<MatrixAxis> read_matrix(const Element& element, const ReportProblem& report) {
  std::vector<MatrixAxis> axes;
  bool empty = true;
  for (const Entry& e : element.inside.entries) {
    if (e.table != "matrix") continue;
    empty = false;
    MatrixAxis axis{e.key, e.node.line, values_of(e), {}};
    const std::string key = "case.matrix." + e.key;
    if (axis.values.empty()) {
      report(e.node.line, key, e.node.text, "not a list of values", "give such as \"contact.stiffness_ratio\" = [0.0, 0.5]");
    } else if (std::set(axis.values.begin(), axis.values.end()).size() < axis.values.size()) {
      report(e.node.line, key, e.node.text, "a value stands twice", "give each value once");
    } else if (is_scene_key(e, report)) {
      add_names(axis);
      axes.push_back(std::move(axis));
    }
  }
  for (const TableHeader& t : element.inside.tables) {
    if (t.name == "matrix" && empty)
      report(t.line, "case.matrix", "", "empty", "give such as \"contact.stiffness_ratio\" = [0.0, 0.5], or leave it out");
  }
  return axes;
}

}  // namespace ddem::harness
