#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "reports/html_parts.h"
#include "reports/margin.h"
#include "reports/number.h"
#include "reports/text.h"

namespace ddem::reports {
namespace {

constexpr std::size_t kBroken = 5, kNearest = 10;

void append_case_link(Markup& out, const std::string& case_id) {
  out.open("a", {{"href", "#" + percent_encode(case_anchor(case_id))}}).element("code", {}, case_id).close();
}

/// Why, in a line: the first criterion that does not hold, else the reason.
std::string why(const Verdict& v) {
  const auto bad = std::find_if(v.criteria.begin(), v.criteria.end(), [](const Criterion& c) { return is_failure(c.state) && std::isfinite(c.actual); });
  if (bad != v.criteria.end()) return outcome_text(*bad);
  return v.reason.empty() ? v.title : v.reason;
}

void append_headcount(Markup& out, const std::vector<Verdict>& verdicts) {
  if (verdicts.empty()) return;
  const bool all = std::all_of(verdicts.begin(), verdicts.end(), [](const Verdict& v) { return is_pass(v.state); });
  const bool failed = std::any_of(verdicts.begin(), verdicts.end(), [](const Verdict& v) { return is_failure(v.state); });
  out.element("p", {{"class", all ? "headcount pass" : failed ? "headcount fail" : "headcount skip"}}, headcount(verdicts)).newline();
}

void append_broken(Markup& out, const std::vector<Verdict>& verdicts) {
  // Each reason once: what ended a unit is that of all its cases.
  std::vector<const Verdict*> broken;
  std::size_t count = 0;
  for (const Verdict* v : worst_first(verdicts)) {
    if (!is_failure(v->state)) continue;
    ++count;
    if (std::none_of(broken.begin(), broken.end(), [v](const Verdict* b) { return why(*b) == why(*v); })) broken.push_back(v);
  }
  if (broken.empty()) return;
  const std::size_t shown = std::min(broken.size(), kBroken);
  out.open("ol", {{"class", "broken"}}).newline();
  for (std::size_t k = 0; k < shown; ++k) {
    const Verdict& v = *broken[k];
    out.open("li");
    append_badge(out, v.state);
    out.text(" ");
    append_case_link(out, v.case_id);
    out.text(" ").element("span", {}, why(v));
    if (!v.reproduce.empty()) out.open("p", {{"class", "reproduce"}}).text("Again: ").element("code", {}, v.reproduce).close();
    out.close().newline();
  }
  out.close().newline();
  if (count > shown) out.element("p", {{"class", "note"}}, fmt::format("and {} more, below", count - shown)).newline();
}

struct Near {
  const Verdict* verdict = nullptr;
  const Criterion* criterion = nullptr;
  double share = 0.0;
};

/// Of every case that passed the criterion that is nearest to its limit; nearest first.
std::vector<Near> nearest(const std::vector<Verdict>& verdicts) {
  std::vector<Near> all;
  for (const Verdict& v : verdicts) {
    if (!is_pass(v.state)) continue;
    Near near{.verdict = &v};
    for (const Criterion& c : v.criteria) {
      const std::optional<double> share = share_of_limit(c);
      if (share && (near.criterion == nullptr || *share > near.share)) near.criterion = &c, near.share = *share;
    }
    if (near.criterion != nullptr) all.push_back(near);
  }
  std::stable_sort(all.begin(), all.end(), [](const Near& a, const Near& b) { return a.share > b.share; });
  return all;
}

std::string percent(double share) { return fmt::format("{:.0f} %", 100.0 * share); }

}  // namespace

void append_conclusion(Markup& out, const Report& report) {
  if (report.findings.empty() && report.verdicts.empty()) return;
  out.open("section", {{"class", "conclusion"}, {"aria-label", "Conclusion"}}).newline();
  append_headcount(out, report.verdicts);
  append_broken(out, report.verdicts);
  out.open("ul").newline();
  for (const std::string& finding : report.findings) out.element("li", {}, finding).newline();
  if (const std::vector<Near> all = nearest(report.verdicts); !all.empty()) {
    out.open("li").text(fmt::format("Of what passed, {} of ", all.front().criterion->metric));
    append_case_link(out, all.front().verdict->case_id);
    const Criterion& c = *all.front().criterion;
    out.text(fmt::format(" is nearest to its limit: {}{}{}, accepted {}, {} of the way there.", number_text(c.actual), c.unit.empty() ? "" : " ", c.unit,
                         accepted_text(c), percent(all.front().share)));
    out.close().newline();
  }
  out.close().close().newline();
}

void append_nearest(Markup& out, const std::vector<Verdict>& verdicts) {
  const std::vector<Near> all = nearest(verdicts);
  if (all.empty()) return;
  const std::string caption = all.size() > kNearest ? fmt::format("The {} cases that passed with the least margin", kNearest) : "Margins of what passed";
  open_scroll_box(out, caption);
  out.open("table", {{"class", "nearest"}}).element("caption", {}, caption).open("thead").open("tr");
  for (const std::string_view heading : {"Case", "Metric", "Way to its limit", "Actual", "Accepted"})
    out.element("th", {{"scope", "col"}}, heading);
  out.close().close().newline().open("tbody");
  for (std::size_t k = 0; k < std::min(all.size(), kNearest); ++k) {
    const Criterion& c = *all[k].criterion;
    out.open("tr").open("th", {{"scope", "row"}});
    append_case_link(out, all[k].verdict->case_id);
    out.close().element("td", {}, c.metric);
    out.open("td", {{"class", "way"}}).open("span", {{"style", fmt::format("width:{:.2f}rem", 6.0 * std::clamp(all[k].share, 0.0, 1.0))}}).close();
    out.text(percent(all[k].share)).close();
    out.element("td", {{"class", "n"}}, number_text(c.actual) + (c.unit.empty() ? "" : " " + c.unit));
    out.element("td", {}, accepted_text(c)).close().newline();
  }
  out.close().close().close().newline();
}

}  // namespace ddem::reports
