#include "harness/solvers/description.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <map>

#include "dem/core/narrow.h"
#include "harness/io/errors.h"
#include "harness/scene/document.h"
#include "harness/scene/nearest_name.h"
#include "harness/scene/text_file.h"
#include "harness/scene/units.h"

namespace ddem::harness {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostBytes = 1 << 16;
constexpr double kLongestRun = 30.0 * 86400.0;  // s
constexpr int kMostRanks = 100000;

/// Sets a member; returns what would be right, or nothing when all is well.
using Setter = std::function<std::string(const Node&)>;

Setter text(std::string& member) {
  return [&member](const Node& node) -> std::string {
    const auto* value = std::get_if<std::string>(&node.value);
    if (value == nullptr || value->empty() || printable(*value, 200) != *value || value->find(',') != std::string::npos)
      return "give a short text without commas";
    member = *value;
    return "";
  };
}

Setter texts(std::vector<std::string>& member, const char* example) {
  return [&member, example](const Node& node) -> std::string {
    const std::string remedy = fmt::format("give a list of texts, such as {}", example);
    const auto* list = std::get_if<Node::List>(&node.value);
    if (list == nullptr || list->empty()) return remedy;
    std::vector<std::string> values;
    for (const Node& item : *list) {
      const auto* value = std::get_if<std::string>(&item.value);
      if (value == nullptr || value->empty() || value->find('\0') != std::string::npos) return remedy;
      values.push_back(*value);
    }
    member = std::move(values);
    return "";
  };
}

Setter folders(std::vector<fs::path>& member) {
  return [&member](const Node& node) -> std::string {
    std::vector<std::string> names;
    if (const std::string problem = texts(names, R"(["/scratch"])")(node); !problem.empty()) return problem;
    for (const std::string& name : names) {
      if (!fs::is_directory(name)) return fmt::format("{} is no folder", printable(name, 200));
      member.emplace_back(name);
    }
    return "";
  };
}

Setter duration(double& member) {
  return [&member](const Node& node) -> std::string {
    Quantity q;
    if (const auto* d = std::get_if<double>(&node.value)) q.si = *d;
    if (const auto* i = std::get_if<std::int64_t>(&node.value)) q.si = static_cast<double>(*i);
    if (const auto* s = std::get_if<std::string>(&node.value)) q = parse_quantity(*s, Dimension::time);
    if (!q.si || !(*q.si > 0.0 && *q.si <= kLongestRun)) return fmt::format("give a time above 0 and up to {} s, such as \"600 s\"", kLongestRun);
    member = *q.si;
    return "";
  };
}

Setter count(int& member) {
  return [&member](const Node& node) -> std::string {
    const auto* value = std::get_if<std::int64_t>(&node.value);
    if (value == nullptr || *value < 1 || *value > kMostRanks) return fmt::format("give a whole number from 1 to {}", kMostRanks);
    member = narrow<int>(*value, "ranks");
    return "";
  };
}

Setter yes_or_no(bool& member) {
  return [&member](const Node& node) -> std::string {
    const auto* value = std::get_if<bool>(&node.value);
    if (value == nullptr) return "give true or false";
    member = *value;
    return "";
  };
}

Setter laws(std::vector<std::string>& member) {
  return [&member](const Node& node) -> std::string {
    const std::vector<std::string> known = builtin_solver().abilities().laws;
    const std::string remedy = fmt::format("give a list of {}", fmt::join(known, ", "));
    std::vector<std::string> values;
    if (!texts(values, "")(node).empty()) return remedy;
    for (const std::string& law : values) {
      if (std::ranges::find(known, law) != known.end()) continue;
      const auto near = nearest_name(law, std::vector<std::string_view>(known.begin(), known.end()));
      return near ? fmt::format("did you mean \"{}\"?", *near) : remedy;
    }
    member = std::move(values);
    return "";
  };
}

std::map<std::string, Setter> setters(SolverDescription& d) {
  Abilities& can = d.abilities;
  return {{"name", text(d.name)},
          {"command", texts(d.command, R"(["python3", "solve.py", "{folder}"])")},
          {"version", texts(d.version_command, R"(["python3", "solve.py", "--version"])")},
          {"time_limit", duration(d.time_limit)},
          {"ranks", count(d.ranks)},
          {"may_write", folders(d.may_write)},
          {"laws", laws(can.laws)},
          {"nonlinear", yes_or_no(can.nonlinear)},
          {"new_contacts", yes_or_no(can.new_contacts)},
          {"periodic", yes_or_no(can.periodic)},
          {"held_discs", yes_or_no(can.held_discs)},
          {"driven_edge", yes_or_no(can.driven_edge)}};
}

class Reader {
 public:
  Reader(const Document& document, const fs::path& path) : document_(document) { description_.path = path; }

  SolverDescription read() {
    const std::map<std::string, Setter> known = setters(description_);
    for (const TableHeader& t : document_.tables) report(t.line, t.name, "", "unknown table", "all keys of a solver stand without one");
    for (const Element& e : document_.elements) report(e.line, e.name, "", "unknown list of tables", "all keys of a solver stand without one");
    for (const Entry& e : document_.entries) take(known, e);
    for (const auto& [key, given] : {std::pair{"name", !description_.name.empty()}, {"command", !description_.command.empty()},
                                     {"laws", !description_.abilities.laws.empty()}}) {
      if (!given && !written_[key]) report(0, key, "", "is missing", "see harness/guide/solvers.md for an example");
    }
    const auto names_folder = [](const std::string& word) { return word.find("{folder}") != std::string::npos; };
    if (!description_.command.empty() && std::ranges::none_of(description_.command, names_folder))
      report(0, "command", "", "names no {folder}", "the program must be told where the scene is: add \"{folder}\"");
    if (!problems_.empty()) throw InputError(problems_);
    return description_;
  }

 private:
  void report(int line, const std::string& key, const std::string& value, const std::string& message, const std::string& remedy) {
    problems_.push_back(to_string(Violation{description_.path.string(), line, 0, key, value, message, remedy}));
  }

  void take(const std::map<std::string, Setter>& known, const Entry& e) {
    if (!e.table.empty()) return;  // which has been reported
    const std::string& key = e.key;
    written_[key] = true;
    const auto found = known.find(key);
    if (found == known.end()) {
      std::vector<std::string_view> names;
      for (const auto& [name, setter] : known) names.push_back(name);
      const auto near = nearest_name(key, names);
      report(e.node.line, key, e.node.text, "unknown key", near ? fmt::format("did you mean {}?", *near) : fmt::format("there are {}", fmt::join(names, ", ")));
      return;
    }
    if (const std::string remedy = found->second(e.node); !remedy.empty()) report(e.node.line, key, e.node.text, "not what this key takes", remedy);
  }

  const Document& document_;
  SolverDescription description_;
  std::map<std::string, bool> written_;
  std::vector<std::string> problems_;
};

[[noreturn]] void refuse(const Violations& violations) {
  std::vector<std::string> lines;
  for (const Violation& v : violations) lines.push_back(to_string(v));
  throw InputError(lines);
}

/// A file beside the description goes by its whole path: the program works in another folder.
void find_files(std::vector<std::string>& words, const fs::path& folder) {
  for (std::string& word : words) {
    std::error_code ignored;
    const fs::path beside = folder / word;
    if (fs::is_regular_file(beside, ignored)) word = fs::absolute(beside).lexically_normal().string();
  }
}

}  // namespace

SolverDescription read_solver_description(const fs::path& path) {
  const auto content = read_text_file(path, kMostBytes);
  if (!content) refuse(content.violations);
  return parse_solver_description(*content, path);
}

SolverDescription parse_solver_description(const std::string& text, const fs::path& path) {
  const auto document = parse_document(text, path.string());
  if (!document) refuse(document.violations);
  SolverDescription d = Reader(*document, path).read();
  d.text = text;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  find_files(d.command, folder);
  find_files(d.version_command, folder);
  return d;
}

}  // namespace ddem::harness
