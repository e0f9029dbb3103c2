#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/html_parts.h"
#include "reports/number.h"
#include "reports/text.h"

namespace ddem::reports {
namespace {

// Where the actual value is between its bounds, at a glance. The numbers are beside it.
void append_gauge(Markup& out, const Criterion& c) {
  const double span = c.upper - c.lower;
  if (!std::isfinite(c.lower) || !std::isfinite(c.upper) || !std::isfinite(span) || !(span > 0.0)) return;
  constexpr double band_left = 24.0, band = 48.0;
  const auto pixel = [&](double v) {
    return band_left + band * std::clamp((v - c.lower) / span, -0.42, 1.42);
  };
  // Hundreds of them: what they share stands once in the page.
  out.open("svg", {{"aria-hidden", "true"}}).empty("use", {{"href", "#gauge"}});
  if (std::isfinite(c.target)) out.empty("path", {{"d", "M" + coordinate(pixel(c.target)) + " 2v12"}});
  if (std::isfinite(c.actual)) {
    out.empty("circle", {{"class", is_failure(c.state) ? "out" : "in"}, {"cx", pixel(c.actual)}, {"cy", 8.0}, {"r", 3.6}});
  }
  out.close();
}

void append_gauge_scale(Markup& out) {
  out.open("svg", {{"class", "hidden"}, {"aria-hidden", "true"}}).open("symbol", {{"id", "gauge"}, {"viewBox", "0 0 96 16"}});
  out.empty("path", {{"class", "axis"}, {"d", "M0 8h96"}}).empty("path", {{"class", "band"}, {"d", "M24 4h48v8h-48z"}});
  out.close().close().newline();
}

// Thousands of cells: how one looks follows from its column (report.css).
void append_criteria(Markup& out, const Verdict& verdict) {
  open_scroll_box(out, "Criteria of " + verdict.case_id);
  out.open("table").open("thead").open("tr");
  for (const std::string_view heading : {"Metric", "State", "Actual", "Target", "Accepted", "Derivation"})
    out.element("th", {{"scope", "col"}}, heading);
  out.close().close().newline().open("tbody");
  for (const Criterion& c : verdict.criteria) {
    const auto with_unit = [&](double v) {
      return number_text(v) + (c.unit.empty() || !std::isfinite(v) ? "" : " " + c.unit);
    };
    out.open("tr").element("th", {{"scope", "row"}}, c.metric);
    out.open("td");
    append_badge(out, c.state);
    out.close();
    out.element("td", {}, std::isfinite(c.actual) ? with_unit(c.actual) : "not measured");
    out.element("td", {}, with_unit(c.target));
    out.open("td");
    append_gauge(out, c);
    out.text(accepted_text(c)).close();
    out.element("td", {}, c.derivation).close().newline();
  }
  out.close().close().close().newline();
}

void open_case(Markup& out, const Verdict& v) {
  std::vector<Attribute> attributes = {{"class", "case"}, {"id", case_anchor(v.case_id)}};
  std::vector<std::string> names;
  for (const auto& [facet, value] : v.facets) names.push_back("data-" + slug(facet));
  for (std::size_t i = 0; i < names.size(); ++i) attributes.emplace_back(names[i], v.facets[i].second);
  // A case that needs attention is open from the start.
  if (is_failure(v.state)) attributes.emplace_back("open", "open");
  out.open("details", attributes);
}

void append_verdict(Markup& out, const Verdict& v) {
  open_case(out, v);
  out.open("summary");
  append_badge(out, v.state);
  out.text(" ").element("code", {}, v.case_id).text(" ").element("span", {{"class", "title"}}, v.title);
  out.close().open("div", {{"class", "body"}});
  if (!v.reason.empty()) out.element("p", {}, v.reason);
  if (!v.criteria.empty()) append_criteria(out, v);
  if (!v.reproduce.empty())
    out.open("p", {{"class", "reproduce"}}).text("Reproduce: ").element("code", {}, v.reproduce).close();
  out.close().close().newline();
}

std::vector<const Verdict*> of_state(const std::vector<const Verdict*>& sorted, State state) {
  std::vector<const Verdict*> chosen;
  std::copy_if(sorted.begin(), sorted.end(), std::back_inserter(chosen),
               [&](const Verdict* v) { return v->state == state; });
  return chosen;
}

// A choice for each facet, values in the order in which they come.
void append_facets(Markup& out, const std::vector<const Verdict*>& sorted) {
  std::vector<std::pair<std::string, std::vector<std::string>>> facets;
  for (const Verdict* v : sorted)
    for (const auto& facet : v->facets) {
      auto known = std::find_if(facets.begin(), facets.end(), [&](const auto& f) { return f.first == facet.first; });
      if (known == facets.end()) known = facets.insert(facets.end(), {facet.first, {}});
      std::vector<std::string>& values = known->second;
      if (std::find(values.begin(), values.end(), facet.second) == values.end()) values.push_back(facet.second);
    }
  for (auto& [facet, values] : facets) {
    std::sort(values.begin(), values.end());
    out.open("label").text(facet + " ").open("select", {{"name", slug(facet)}});
    out.element("option", {{"value", ""}}, "all");
    for (const std::string& value : values) out.element("option", {{"value", value}}, value);
    out.close().close();
  }
}

void append_filter(Markup& out, const std::vector<const Verdict*>& sorted) {
  out.open("div", {{"class", "filter"}, {"role", "group"}, {"aria-label", "Show cases"}});
  out.element("button", {{"type", "button"}, {"data-show", ""}, {"aria-pressed", "true"}},
              fmt::format("All {}", sorted.size()));
  for (const State state : kStatesWorstFirst)
    if (const std::size_t n = of_state(sorted, state).size(); n > 0)
      out.element("button", {{"type", "button"}, {"data-show", to_string(state)}, {"aria-pressed", "false"}},
                  fmt::format("{} {}", to_string(state), n));
  append_facets(out, sorted);
  out.open("label").text("Words ").empty("input", {{"type", "search"}, {"placeholder", "kt0.30"}}).close();
  out.close().element("p", {{"class", "note shown"}, {"role", "status"}}, "").newline();
}

// Shares of passed, skipped and failed cases as a bar.
void append_bar(Markup& out, const std::vector<const Verdict*>& sorted) {
  out.open("div", {{"class", "bar"}, {"aria-hidden", "true"}});
  for (const State state : kStatesWorstFirst)
    if (const std::size_t n = of_state(sorted, state).size(); n > 0)
      out.element("span", {{"class", state_class(state)}, {"style", fmt::format("flex-grow:{}", n)}}, "");
  out.close().newline();
}

}  // namespace

// Hundreds of them: the tick or cross before the word is the style sheet's.
void append_badge(Markup& out, State state) {
  out.element("span", {{"class", fmt::format("badge {}", state_class(state))}}, to_string(state));
}

std::string_view state_class(State state) {
  if (is_pass(state)) return "pass";
  if (state == State::skipped || state == State::no_baseline) return "skip";
  return state == State::error ? "error" : "fail";
}

// No blanks in ids.
std::string case_anchor(std::string_view case_id) {
  std::string anchor = "case-" + std::string(case_id);
  std::replace(anchor.begin(), anchor.end(), ' ', '_');
  return anchor;
}

void append_verdicts(Markup& out, const std::vector<Verdict>& verdicts) {
  if (verdicts.empty()) return;
  const std::vector<const Verdict*> sorted = worst_first(verdicts);
  out.open("section", {{"id", "verdicts"}, {"class", "verdicts"}}).element("h2", {}, "Verdicts").newline();
  append_bar(out, sorted);
  append_nearest(out, verdicts);
  append_filter(out, sorted);
  append_gauge_scale(out);
  for (const State state : kStatesWorstFirst) {
    const std::vector<const Verdict*> cases = of_state(sorted, state);
    if (cases.empty()) continue;
    const std::string_view name = to_string(state);
    if (is_pass(state))
      out.open("details", {{"class", "group"}, {"data-state", name}});
    else
      out.open("details", {{"class", "group"}, {"data-state", name}, {"open", "open"}});
    out.element("summary", {},
                fmt::format("{}: {} {}", name, cases.size(), cases.size() == 1 ? "case" : "cases"));
    out.newline();
    for (const Verdict* v : cases) append_verdict(out, *v);
    out.close().newline();
  }
  out.close().newline();
}

}  // namespace ddem::reports
