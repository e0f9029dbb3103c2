#include "harness/campaign/read_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "harness/io/json.h"
#include "harness/scene/nearest_name.h"
#include "harness/scene/text_file.h"

namespace ddem::harness {
namespace {

constexpr std::size_t kMostBytes = std::size_t{4} << 20;
constexpr std::size_t kMostPoints = 10000;

/// A name as a part of a file's name.
bool is_plain(const std::string& id) {
  const auto plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' || c == '.';
  };
  return !id.empty() && id.size() <= 100 && id.front() != '.' && std::all_of(id.begin(), id.end(), plain);
}

std::string toml_text(const Node& node) {
  if (const auto* b = std::get_if<bool>(&node.value)) return *b ? "true" : "false";
  if (const auto* i = std::get_if<std::int64_t>(&node.value)) return fmt::format("{}", *i);
  if (const auto* d = std::get_if<double>(&node.value)) return fmt::format("{}", *d);
  if (const auto* s = std::get_if<std::string>(&node.value)) return Json(*s).dump();
  return "";
}

/// A setter takes a node, or says what would be right.
using Setter = std::function<std::string(const Node&)>;

Setter text(std::string& member) {
  return [&member](const Node& n) -> std::string {
    const auto* s = std::get_if<std::string>(&n.value);
    if (s == nullptr || s->empty()) return "give a text";
    member = *s;
    return "";
  };
}

std::optional<double> finite_number(const Node& n) {
  if (const auto* i = std::get_if<std::int64_t>(&n.value)) return static_cast<double>(*i);
  if (const auto* d = std::get_if<double>(&n.value); d != nullptr && std::isfinite(*d)) return *d;
  return std::nullopt;
}

Setter number(std::optional<double>& member) {
  return [&member](const Node& n) -> std::string {
    const auto value = finite_number(n);
    if (!value) return "give a finite number";
    member = *value;
    return "";
  };
}

Setter metric(std::string& member) {
  return [&member](const Node& n) -> std::string {
    const auto* s = std::get_if<std::string>(&n.value);
    if (s == nullptr || s->empty() || !group_of(*s)) {
      return "give a number of ddem run --json, such as \"wave_speed\", or of ddem moduli, fem, stability as "
             "\"static.\", \"fem.\", \"stability.\" and its name";
    }
    member = *s;
    return "";
  };
}

Setter target(CaseCriterion& c) {
  return [&c](const Node& n) -> std::string {
    if (std::holds_alternative<std::string>(n.value)) return metric(c.reference)(n);
    return number(c.target)(n);
  };
}

class CaseReader {
 public:
  CaseReader(const std::filesystem::path& file, std::vector<std::string>& problems)
      : file_(file), problems_(problems) {}

  std::vector<UserCase> read(const Document& document) {
    for (const Element& element : document.elements) {
      if (element.name == "case") read_case(element);
    }
    return std::move(cases_);
  }

 private:
  struct Axis {
    std::string key;
    int line = 0;
    std::vector<std::string> values;
  };

  void report(int line, const std::string& key, const std::string& value, const std::string& message,
              const std::string& remedy) {
    problems_.push_back(to_string(Violation{file_.string(), line, 0, key, value, message, remedy}));
  }

  /// The entries of one table by their setters.
  void take(const Document& d, const std::string& table, const std::string& where,
            const std::map<std::string, Setter>& setters) {
    std::vector<std::string_view> names;
    for (const auto& [name, setter] : setters) names.push_back(name);
    for (const Entry& e : d.entries) {
      const bool array = std::any_of(d.elements.begin(), d.elements.end(),
                                     [&](const Element& x) { return e.table.empty() && x.name == e.key; });
      if (e.table != table || array) continue;
      const auto known = setters.find(e.key);
      if (known == setters.end()) {
        const auto near = nearest_name(e.key, names);
        report(e.node.line, where + "." + e.key, e.node.text, "unknown key",
               near ? fmt::format("did you mean {}?", *near)
                    : fmt::format("the keys are {}", fmt::join(names, ", ")));
      } else if (const std::string remedy = known->second(e.node); !remedy.empty()) {
        report(e.node.line, where + "." + e.key, e.node.text, "not a value of this key", remedy);
      }
    }
  }

  void read_case(const Element& element) {
    UserCase c;
    const std::size_t problems_before = problems_.size();
    take(element.inside, "", "case",
         {{"id", text(c.id)}, {"title", text(c.title)}, {"scene", text(c.scene)}});
    for (const TableHeader& t : element.inside.tables) {
      if (t.name != "matrix")
        report(t.line, "case." + t.name, "", "unknown table",
               "a case has [case.matrix] and [[case.criterion]]");
    }
    for (const Element& inner : element.inside.elements) {
      if (inner.name == "criterion")
        c.criteria.push_back(read_criterion(inner));
      else
        report(inner.line, "case." + inner.name, "", "unknown table",
               "a case has [case.matrix] and [[case.criterion]]");
    }
    if (c.criteria.empty())
      report(element.line, "case.criterion", "", "missing",
             "a case without [[case.criterion]] checks nothing");
    if (!is_plain(c.id))
      report(element.line, "case.id", c.id, "missing or no name",
             "give a name of letters, digits, '-', '_' and '.'");
    const std::vector<Axis> axes = read_matrix(element);
    read_scene_text(element, c);
    if (problems_.size() == problems_before) expand(element, c, axes);
  }

  CaseCriterion read_criterion(const Element& element) {
    CaseCriterion c;
    const std::size_t problems_before = problems_.size();
    take(element.inside, "", "case.criterion",
         {{"metric", metric(c.metric)},
          {"target", target(c)},
          {"lower", number(c.lower)},
          {"upper", number(c.upper)},
          {"unit", text(c.unit)},
          {"derivation", text(c.derivation)}});
    if (problems_.size() != problems_before) return c;
    const auto lacks = [&](const char* key, const char* remedy) {
      report(element.line, std::string("case.criterion.") + key, "", "missing", remedy);
    };
    if (c.metric.empty()) lacks("metric", "name what is judged, such as \"wave_speed\"");
    if (c.derivation.empty()) lacks("derivation", "say where target and tolerance come from");
    if (!c.lower && !c.upper)
      lacks("lower",
            "give lower, upper or both: shares of the target such as -0.01 and 0.01, or without a target the "
            "bounds themselves");
    const bool has_target = c.target || !c.reference.empty();
    if (c.lower && c.upper && *c.lower > *c.upper)
      report(element.line, "case.criterion.lower", fmt::format("{}", *c.lower), "above upper",
             "nothing would pass");
    if (has_target && (c.lower.value_or(0.0) > 0.0 || c.upper.value_or(0.0) < 0.0)) {
      report(element.line, "case.criterion.lower", "", "the target itself would fail",
             "of a target, lower and upper are shares: lower at most 0, upper at least 0");
    }
    if (c.target == 0.0)
      report(element.line, "case.criterion.target", "0", "shares of it are nothing",
             "leave it out, and give lower and upper as bounds");
    return c;
  }

  std::vector<Axis> read_matrix(const Element& element) {
    std::vector<Axis> axes;
    for (const Entry& e : element.inside.entries) {
      if (e.table != "matrix") continue;
      const auto* list = std::get_if<Node::List>(&e.node.value);
      Axis axis{e.key, e.node.line, {}};
      for (std::size_t k = 0; list != nullptr && k < list->size(); ++k)
        axis.values.push_back(toml_text((*list)[k]));
      const bool good =
          !axis.values.empty() && std::find(axis.values.begin(), axis.values.end(), "") == axis.values.end();
      if (!good)
        report(e.node.line, "case.matrix." + e.key, e.node.text, "not a list of values",
               "give such as \"contact.stiffness_ratio\" = [0.0, 0.5]");
      if (good && e.key.find('.') == std::string::npos)
        report(e.node.line, "case.matrix." + e.key, e.node.text, "no key of a scene",
               "name it with its table, in quotes: \"contact.stiffness_ratio\"");
      axes.push_back(axis);
    }
    return axes;
  }

  void read_scene_text(const Element& element, UserCase& c) {
    if (c.scene.empty())
      return report(element.line, "case.scene", "", "missing",
                    "name the scene's file; it is looked for beside this one");
    const std::filesystem::path path = file_.parent_path() / c.scene;
    c.scene = path.string();
    const Checked<std::string> content = read_text_file(path, kMostBytes);
    if (content) c.text = *content;
    for (const Violation& v : content.violations) report(element.line, "case.scene", "", to_string(v), "");
  }

  /// One case a point of the matrix, each with its scene read.
  void expand(const Element& element, const UserCase& c, const std::vector<Axis>& axes) {
    std::size_t points = 1;
    for (const Axis& a : axes) points *= std::min(a.values.size(), kMostPoints + 1);
    if (points > kMostPoints)
      return report(element.line, "case.matrix", "", fmt::format("{} points", points),
                    fmt::format("at most {} are allowed", kMostPoints));
    for (std::size_t p = 0; p < points; ++p) {
      UserCase point = c;
      std::size_t rest = p;
      for (auto a = axes.rbegin(); a != axes.rend(); ++a) {
        point.overrides.insert(point.overrides.begin(), {a->key, a->values[rest % a->values.size()]});
        rest /= a->values.size();
      }
      for (const SceneOverride& o : point.overrides)
        point.id += "/" + plain(o.key.substr(o.key.rfind('.') + 1) + "=" + o.value);
      if (point.title.empty()) point.title = point.id;
      if (!ids_.insert(point.id).second)
        report(element.line, "case.id", point.id, "used twice", "every case has a name of its own");
      const SceneResult scene = scene_of_case(point);
      for (const Violation& v : scene.violations) report(element.line, "case", point.id, to_string(v), "");
      cases_.push_back(std::move(point));
    }
  }

  static std::string plain(std::string text) {
    std::erase(text, '"');
    for (char& c : text) {
      if (!is_plain(std::string("x") + c) && c != '=') c = '-';
    }
    return text;
  }

  std::filesystem::path file_;
  std::vector<std::string>& problems_;
  std::vector<UserCase> cases_;
  std::set<std::string> ids_;
};

}  // namespace

std::vector<UserCase> read_cases(const Document& document, const std::filesystem::path& file,
                                 std::vector<std::string>& problems) {
  return CaseReader(file, problems).read(document);
}

}  // namespace ddem::harness
