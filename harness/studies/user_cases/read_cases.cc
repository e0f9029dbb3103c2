#include "harness/studies/user_cases/read_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "harness/studies/user_cases/case_matrix.h"
#include "harness/studies/user_cases/metrics.h"
#include "harness/scene/nearest_name.h"
#include "harness/scene/text_file.h"
#include "harness/scene/units.h"
#include "reports/text.h"

namespace ddem::harness {
namespace {

constexpr std::size_t kMostBytes = std::size_t{4} << 20;
constexpr std::size_t kMostPoints = 10000;
constexpr std::size_t kLongestId = 100;  // of the 255 bytes of a file's name, to which endings, a case's folder and temporary files add

/// A name as a part of a file's name.
bool is_plain(const std::string& id) {
  const auto plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' || c == '.';
  };
  return !id.empty() && id.front() != '.' && std::all_of(id.begin(), id.end(), plain);
}

/// What can be shown, in a report and on a terminal: no control characters but line breaks and tabs.
bool is_shown(const std::string& text) {
  return reports::clean_utf8(text) == text;
}

/// A setter takes a node, or says what would be right.
using Setter = std::function<std::string(const Node&)>;

Setter text(std::string& member) {
  return [&member](const Node& n) -> std::string {
    const auto* s = std::get_if<std::string>(&n.value);
    if (s == nullptr || s->empty() || !is_shown(*s)) return "give a text without control characters";
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
    if (s == nullptr) return "give a text, such as \"wave_speed\"";
    if (const MetricProblem problem = problem_of_metric(*s); !problem.message.empty()) return problem.message + "; " + problem.remedy;
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
    lines_.clear();
    take(element.inside, "", "case",
         {{"id", text(c.id)}, {"title", text(c.title)}, {"scene", text(c.scene)}});
    for (const TableHeader& t : element.inside.tables) {
      if (t.name != "matrix")
        report(t.line, "case." + t.name, "", "unknown table",
               "a case has [case.matrix] and [[case.criterion]]");
    }
    bool has_criteria = false;
    for (const Element& inner : element.inside.elements) {
      if (inner.name == "criterion")
        has_criteria = true, add_criterion(inner, c);
      else
        report(inner.line, "case." + inner.name, "", "unknown table",
               "a case has [case.matrix] and [[case.criterion]]");
    }
    if (!has_criteria)
      report(element.line, "case.criterion", "", "missing",
             "a case without [[case.criterion]] checks nothing");
    check_id(element, c.id);
    const auto axes = read_matrix(element, [this](auto&&... problem) { report(problem...); });
    // Whatever else is wrong: what is wrong with the scene is said at once.
    if (read_scene_text(element, c)) expand(element, c, axes);
  }

  void check_id(const Element& element, const std::string& id) {
    const auto entry = std::ranges::find_if(element.inside.entries, [](const Entry& e) { return e.table.empty() && e.key == "id"; });
    const int line = entry != element.inside.entries.end() ? entry->node.line : element.line;
    if (id.size() > kLongestId)
      report(line, "case.id", id, fmt::format("{} bytes long, and files are named after it", id.size()), fmt::format("at most {} bytes are allowed", kLongestId));
    else if (!is_plain(id))
      report(line, "case.id", id, "missing or no name", "give a name of letters, digits, '-', '_' and '.'");
  }

  void add_criterion(const Element& element, UserCase& c) {
    const CaseCriterion criterion = read_criterion(element);
    if (criterion.metric.empty()) return;
    c.criteria.push_back(criterion);
    lines_.push_back(element.line);
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
    if (!c.metric.empty() && !c.unit.empty()) check_unit(element.line, c);
    const bool has_target = c.target || !c.reference.empty();
    if (!c.reference.empty() && c.reference == c.metric)
      report(element.line, "case.criterion.target", c.reference, "a metric is as good as itself", "name another metric, or give a number");
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

  /// Target and bounds are plain numbers, hence in the SI unit, however that is spelt.
  void check_unit(int line, CaseCriterion& c) {
    const Dimension dimension = dimension_of_metric(c.metric);
    const std::string_view si = si_unit(dimension);
    if (!si.empty() && parse_quantity("1 " + c.unit, dimension).si == 1.0) {
      c.unit = si;
      return;
    }
    report(line, "case.criterion.unit", c.unit, fmt::format("{} {}", c.metric, si.empty() ? "has no unit" : fmt::format("is in {}", si)),
           si.empty() ? "leave unit out" : fmt::format("give target and bounds in {}, and unit = \"{}\" or none", si, si));
  }

  bool read_scene_text(const Element& element, UserCase& c) {
    if (c.scene.empty()) {
      report(element.line, "case.scene", "", "missing", "name the scene's file; it is looked for beside this one");
      return false;
    }
    const std::filesystem::path path = file_.parent_path() / c.scene;
    c.scene = path.string();
    const Checked<std::string> content = read_text_file(path, kMostBytes);
    if (content) c.text = *content;
    for (const Violation& v : content.violations) report(element.line, "case.scene", "", to_string(v), "");
    return content.value.has_value();
  }

  /// One case a point of the matrix, each with its scene read.
  void expand(const Element& element, const UserCase& c, const std::vector<MatrixAxis>& axes) {
    std::size_t points = 1;
    for (const MatrixAxis& a : axes) points *= std::min(a.values.size(), kMostPoints + 1);
    if (points > kMostPoints)
      return report(element.line, "case.matrix", "", fmt::format("{} points", points),
                    fmt::format("at most {} are allowed", kMostPoints));
    said_.clear();
    for (std::size_t p = 0; p < points; ++p) {
      UserCase point = c;
      std::size_t rest = p;
      for (auto a = axes.rbegin(); a != axes.rend(); ++a) {
        const std::size_t k = rest % a->values.size();
        point.overrides.insert(point.overrides.begin(), {a->key, a->values[k]});
        point.id.insert(c.id.size(), "/" + a->names[k]);
        rest /= a->values.size();
      }
      if (point.title.empty()) point.title = point.id;
      if (!ids_.insert(point.id).second)
        report(element.line, "case.id", point.id, "used twice", "every case has a name of its own");
      check_scene_of(element, point, axes);
      cases_.push_back(std::move(point));
    }
  }

  /// What is wrong with a point of the matrix: at the line that is to blame, and once for all points that have it.
  void check_scene_of(const Element& element, const UserCase& point, const std::vector<MatrixAxis>& axes) {
    const SceneResult scene = scene_of_case(point);
    for (const Violation& v : scene.violations) {
      if (!said_.insert(to_string(v)).second) continue;
      const auto axis = std::find_if(axes.begin(), axes.end(), [&](const MatrixAxis& a) { return a.key == v.key; });
      if (axis != axes.end())
        report(axis->line, "case.matrix." + axis->key, v.value, v.message, v.remedy);
      else
        report(element.line, "case", point.id, to_string(v), "");
    }
    if (!scene) return;
    for (std::size_t k = 0; k < point.criteria.size(); ++k) {
      const CaseCriterion& c = point.criteria[k];
      for (const auto& [key, metric] : {std::pair("metric", c.metric), std::pair("target", c.reference)}) {
        if (metric.empty()) continue;
        const MetricProblem p = problem_of_metric(metric, *scene);
        if (!p.message.empty() && said_.insert(fmt::format("{} {} {} {}", lines_[k], key, metric, p.message)).second)
          report(lines_[k], std::string("case.criterion.") + key, metric, fmt::format("{} cannot have it: {}", point.id, p.message), p.remedy);
      }
    }
  }

  std::filesystem::path file_;
  std::vector<std::string>& problems_;
  std::vector<UserCase> cases_;
  std::set<std::string> ids_;
  std::vector<int> lines_;      ///< of the criteria of the case that is being read
  std::set<std::string> said_;  ///< of it
};

}  // namespace

std::vector<UserCase> read_cases(const Document& document, const std::filesystem::path& file,
                                 std::vector<std::string>& problems) {
  return CaseReader(file, problems).read(document);
}

}  // namespace ddem::harness
