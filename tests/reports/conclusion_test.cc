// What the report opens with, and numbers of a column side by side.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "reports/column_format.h"
#include "reports/margin.h"
#include "reports/report.h"

namespace ddem::reports {
namespace {

Criterion within(double actual, double lower, double upper, double target) {
  return {.metric = "speed", .actual = actual, .target = target, .lower = lower, .upper = upper, .unit = "m/s", .state = State::pass};
}

TEST(ShareOfLimit, IsNoneWhereRightAndOneAtEitherLimit) {
  EXPECT_EQ(share_of_limit(within(100, 90, 110, 100)), 0.0);
  EXPECT_EQ(share_of_limit(within(110, 90, 110, 100)), 1.0);
  EXPECT_EQ(share_of_limit(within(90, 90, 110, 100)), 1.0);
  // Right is not in the middle: each side has its own scale.
  EXPECT_DOUBLE_EQ(share_of_limit(within(102, 60, 104, 100)).value(), 0.5);
  EXPECT_DOUBLE_EQ(share_of_limit(within(80, 60, 104, 100)).value(), 0.5);
  EXPECT_DOUBLE_EQ(share_of_limit({.actual = 2.5e-4, .upper = 1e-3}).value(), 0.25);
  EXPECT_DOUBLE_EQ(share_of_limit(within(75, 0, 100, std::nan(""))).value(), 0.5);
  // Towards the side without a limit nothing is on its way.
  const double open = std::numeric_limits<double>::infinity();
  EXPECT_EQ(share_of_limit(within(2687, 1980, open, 2000)), 0.0);
  EXPECT_DOUBLE_EQ(share_of_limit(within(1990, 1980, open, 2000)).value(), 0.5);
  EXPECT_EQ(share_of_limit(within(-5, -open, 10, 0)), 0.0);
  EXPECT_EQ(share_of_limit({.actual = -3, .upper = 1e-3}), 0.0);
  EXPECT_FALSE(share_of_limit({.actual = -0.456, .upper = -0.3}));
  // What was not measured, bounds that meet, and what only has to be large.
  EXPECT_FALSE(share_of_limit(within(std::nan(""), 90, 110, 100)));
  EXPECT_FALSE(share_of_limit(within(25, 25, 25, 25)));
  EXPECT_FALSE(share_of_limit({.actual = 1e9, .lower = 1.0}));
}

TEST(ColumnFormat, GivesAllNumbersTheSameDecimals) {
  const auto column = [](std::vector<double> values, int digits) {
    const ColumnFormat format(values, digits);
    std::string all;
    for (const double v : values) all += format.text(v) + " ";
    return all;
  };
  EXPECT_EQ(column({1.0, 0.5, 12.25}, 6), "1.00 0.50 12.25 ");
  EXPECT_EQ(column({1545.0968080927528, 2676.186}, 6), "1545.10 2676.19 ");
  EXPECT_EQ(column({682, 10, 0}, 6), "682 10 0 ");
  EXPECT_EQ(column({1e6, 3}, 3), "1000000 3 ");
  EXPECT_EQ(column({0.3, -0.25, 0.0}, 6), "0.30 −0.25 0.00 ");
  EXPECT_EQ(column({2.5e-9, 1e-12, 0.0}, 6), "2.5×10⁻⁹ 1.0×10⁻¹² 0 ");
  EXPECT_EQ(column({1.1547e10, 4.33e9}, 4), "1.155×10¹⁰ 4.330×10⁹ ");
  EXPECT_EQ(column({0.5, 1e-9}, 3), "5×10⁻¹ 1×10⁻⁹ ");
  EXPECT_EQ(column({std::nan(""), 1.5}, 3), "– 1.5 ");
  EXPECT_EQ(column({0.1, 81.0, 1032.2}, 2), "0.1 81.0 1032.2 ");  // percentages in tenths
  EXPECT_EQ(column({1.5}, 0), "1.5 ");
  EXPECT_EQ(column({1.5, 1e-12}, 2), "1.5×10⁰ 1.0×10⁻¹² ");  // which is not 0.0
  EXPECT_EQ(column({}, 3), "");
}

/// In the order in which the page says it.
void expect_in_order(const std::string& page, const std::vector<std::string>& texts) {
  std::size_t at = 0;
  for (const std::string& text : texts) {
    const std::size_t found = page.find(text, at);
    ASSERT_NE(found, std::string::npos) << text << " is not there, or not in its place";
    at = found + text.size();
  }
}

TEST(Conclusion, OpensWithWhatBrokeAndWhatWasFound) {
  Report r{.title = "t", .findings = {"It works."}, .summary = {"A strip."}, .headlines = {{"nu", "0.4", ""}}};
  r.verdicts = {{.case_id = "far", .state = State::pass, .criteria = {within(101, 90, 110, 100)}},
                {.case_id = "near one", .state = State::pass, .criteria = {within(100, 90, 110, 100), within(109, 90, 110, 100)}},
                {.case_id = "bad", .state = State::fail, .criteria = {{.metric = "speed", .actual = 3, .upper = 1, .state = State::fail}}, .reproduce = "ddem again"}};
  const std::string page = render_html(r);
  expect_in_order(page, {"<h1>t</h1>", "2 of 3 passed, 1 FAIL", "href=\"#case-bad\"", "speed: 3", "ddem again", "It works.", "speed of ", "href=\"#case-near_one\"",
                         "90 % of the way", "0.4", "A strip.", "id=\"verdicts\"", "Margins of what passed", "near one", "90 %", "far", "10 %",
                         "id=\"case-bad\"", "id=\"case-near_one\""});
  // No more than ten, and five that broke.
  for (int k = 0; k < 12; ++k) {
    r.verdicts.push_back({.case_id = "pass-" + std::to_string(k), .state = State::pass, .criteria = {within(101, 90, 110, 100)}});
    r.verdicts.push_back({.case_id = "fail-" + std::to_string(k), .state = State::fail, .reason = "no " + std::to_string(k)});
  }
  expect_in_order(render_html(r), {"and 8 more, below", "The 10 cases that passed with the least margin"});
}

/// A warning beside a criterion that fails is not why; a reason that many cases share is told once.
TEST(Conclusion, TellsWhyOnce) {
  Report r{.title = "t"};
  r.verdicts = {{.case_id = "bad", .state = State::fail, .reason = "a warning", .criteria = {{.metric = "speed", .actual = 3, .upper = 1, .state = State::fail}}},
                {.case_id = "one", .state = State::error, .reason = "crashed"},
                {.case_id = "two", .state = State::error, .reason = "crashed"}};
  const std::string page = render_html(r), opening = page.substr(0, page.find("id=\"verdicts\""));
  expect_in_order(opening, {"#case-one", "crashed", "#case-bad", "speed: 3", "and 1 more, below"});
  EXPECT_EQ(opening.find("#case-two"), std::string::npos);
  EXPECT_EQ(opening.find("a warning"), std::string::npos);
}

TEST(Tables, AreFoldedAboveFifteenRows) {
  Report r{.title = "t", .sections = {{.heading = "h", .tables = {{.caption = "caption", .columns = {{"n"}}}}}}};
  auto& rows = r.sections.front().tables.front().rows;
  rows.assign(15, {1.0});
  EXPECT_EQ(render_html(r).find("<details class=\"rows\">"), std::string::npos);
  rows.push_back({2.0});
  expect_in_order(render_html(r), {"<details class=\"rows\">", "caption (16 rows)", "class=\"long\""});
}

}  // namespace
}  // namespace ddem::reports
