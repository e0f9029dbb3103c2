#include "reports/junit.h"

#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>
#include <sstream>

#include "reports/text.h"

namespace ddem::reports {
namespace {

const char* outcome_element(State state) {
  if (state == State::error) return "error";
  if (is_failure(state)) return "failure";
  return is_pass(state) ? nullptr : "skipped";
}

std::string details(const Verdict& v) {
  std::string text = v.reason;
  for (const Criterion& c : v.criteria) {
    text.append(text.empty() ? "" : "\n").append(outcome_text(c));
    if (!c.derivation.empty()) text.append("\n    derivation: ").append(c.derivation);
  }
  if (!v.reproduce.empty()) text.append("\nreproduce: ").append(v.reproduce);
  return text;
}

// One line: the first criterion that is not met says more than the verdict's general reason.
std::string message(const Verdict& v) {
  std::string text = v.reason;
  for (const Criterion& c : v.criteria)
    if (is_failure(c.state)) {
      text.append(text.empty() ? "" : "; ").append(outcome_text(c));
      if (!c.derivation.empty()) text.append(" (").append(c.derivation).append(")");
    }
  return text.empty() ? std::string(to_string(v.state)) : text;
}

std::string seconds_text(double seconds) {
  return fmt::format("{:.6f}", seconds);
}

void append_case(pugi::xml_node suite, std::string_view suite_name, const Verdict& v) {
  pugi::xml_node node = suite.append_child("testcase");
  node.append_attribute("classname").set_value(clean_utf8(suite_name).c_str());
  node.append_attribute("name").set_value(clean_utf8(v.case_id).c_str());
  node.append_attribute("time").set_value(seconds_text(v.seconds).c_str());
  if (const char* element = outcome_element(v.state)) {
    pugi::xml_node outcome = node.append_child(element);
    outcome.append_attribute("message").set_value(clean_utf8(message(v)).c_str());
    outcome.append_attribute("type").set_value(std::string(to_string(v.state)).c_str());
    outcome.text().set(clean_utf8(details(v)).c_str());
  } else {
    node.append_child("system-out").text().set(clean_utf8(v.title + "\n" + details(v)).c_str());
  }
}

}  // namespace

std::string render_junit(std::string_view suite, const std::vector<Verdict>& verdicts) {
  const auto count = [&](std::string_view element) {
    return static_cast<unsigned long long>(
        std::count_if(verdicts.begin(), verdicts.end(), [&](const Verdict& v) {
          const char* own = outcome_element(v.state);
          return own != nullptr && own == element;
        }));
  };
  double seconds = 0.0;
  for (const Verdict& v : verdicts) seconds += v.seconds;
  pugi::xml_document document;
  pugi::xml_node root = document.append_child("testsuites");
  pugi::xml_node node = root.append_child("testsuite");
  node.append_attribute("name").set_value(clean_utf8(suite).c_str());
  for (pugi::xml_node n : {root, node}) {
    n.append_attribute("tests").set_value(static_cast<unsigned long long>(verdicts.size()));
    n.append_attribute("failures").set_value(count("failure"));
    n.append_attribute("errors").set_value(count("error"));
    n.append_attribute("skipped").set_value(count("skipped"));
    n.append_attribute("time").set_value(seconds_text(seconds).c_str());
  }
  for (const Verdict& v : verdicts) append_case(node, suite, v);
  std::ostringstream out;
  document.save(out, "  ");
  return out.str();
}

}  // namespace ddem::reports
