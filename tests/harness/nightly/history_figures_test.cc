// Trends in the report, from made-up nights: what regressed is drawn first, where it belongs, and inside which band.

#include "harness/nightly/history_figures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "harness/nightly/history_page.h"
#include "tests/harness/nightly/made_up_nights.h"

namespace ddem::harness::nightly {
namespace {

using reports::Plot;
using reports::State;

std::map<std::string, reports::Figure> figures_of(const reports::Section& section) {
  std::map<std::string, reports::Figure> figures;
  for (const reports::Figure& f : section.figures) {
    EXPECT_NO_THROW(reports::require_valid(f));
    figures[f.id] = f;
  }
  return figures;
}

const Plot& panel(const reports::Figure& figure, std::size_t k) {
  return std::get<Plot>(figure.panels.at(k));
}

TEST(HistoryFigures, AJumpIsTheFirstPanelAndOutsideItsBand) {
  const auto figures = figures_of(history_section(made_up_nights(30)));
  const reports::Figure& figure = figures.at("history-metrics");
  EXPECT_EQ(figure.panels.size(), 8u);
  const Plot& jump = panel(figure, 0);
  EXPECT_EQ(jump.title, "REGRESSED: wave/jump: jumps");
  ASSERT_EQ(jump.series.at(0).y.size(), 30u);
  EXPECT_EQ(jump.series[0].x.front(), -29.0);
  EXPECT_EQ(jump.series[0].x.back(), 0.0);
  // (105 - 100) / 10 and (101 - 100) / 10.
  EXPECT_DOUBLE_EQ(jump.series[0].y.back(), 0.5);
  EXPECT_DOUBLE_EQ(jump.series[0].y[28], 0.1);
  // Equal nights scatter by 1 % of the half band: 0.1 -+ 0.01. Of 29 nights before, windows of 20 and of all differ.
  ASSERT_EQ(jump.bands.size(), 3u);
  const double begins[] = {-29.0, -20.0, -4.0};
  for (std::size_t b = 0; b < 3; ++b) {
    EXPECT_NEAR(jump.bands[b].lower[1], 0.09, 1e-12);
    EXPECT_NEAR(jump.bands[b].upper[1], 0.11, 1e-12);
    EXPECT_EQ(jump.bands[b].x, (std::vector<double>{begins[b], 0.0}));
  }
  EXPECT_TRUE(jump.references.empty());  // halfway to the limit at most
  // Then what is nearest to its limit, although it did not change.
  EXPECT_EQ(panel(figure, 1).title, "wave/near: near its limit");
  ASSERT_EQ(panel(figure, 1).references.size(), 1u);
  EXPECT_DOUBLE_EQ(panel(figure, 1).references[0].value, 1.0);
  EXPECT_EQ(panel(figure, 2).title, "energy: drift");
}

TEST(HistoryFigures, NothingRegressedWhereNothingChanged) {
  std::vector<Night> all = made_up_nights(30);
  all.back() = made_up_night(29, 1000);
  const reports::Section section = history_section(all);
  const auto figures = figures_of(section);
  for (const reports::Panel& p : figures.at("history-metrics").panels)
    EXPECT_EQ(std::get<Plot>(p).title.find("REGRESSED"), std::string::npos);
  EXPECT_TRUE(section.tables.at(0).rows.empty());
  EXPECT_NE(section.paragraphs.at(0).find("0 of them regressed"), std::string::npos);
}

TEST(HistoryFigures, TheTableHasWhatRegressed) {
  const reports::Table table = history_section(made_up_nights(30)).tables.at(0);
  ASSERT_EQ(table.rows.size(), 1u);
  ASSERT_EQ(table.rows[0].size(), table.columns.size());
  EXPECT_EQ(std::get<std::string>(table.rows[0][2].value), "REGRESSED");
  EXPECT_DOUBLE_EQ(std::get<double>(table.rows[0][5].value), 4.0);  // from the median of 4 nights
}

TEST(HistoryFigures, EachChecksWorstMetric) {
  const Plot plot = panel(figures_of(history_section(made_up_nights(5))).at("history-margins"), 0);
  std::map<std::string, double> last;
  for (const reports::Series& s : plot.series) last[s.name] = s.y.back();
  ASSERT_EQ(last.size(), 3u);
  EXPECT_DOUBLE_EQ(last.at("wave"), 0.95);
  EXPECT_DOUBLE_EQ(last.at("energy"), 0.25);
  EXPECT_DOUBLE_EQ(last.at("static"), 0.0);
}

/// 0.9 of the way from the target to the near one of its limits, 0.3 to the far one.
TEST(HistoryFigures, LimitsAreAtOneOnBothSidesOfTheTarget) {
  std::vector<Night> all = made_up_nights(3);
  for (Night& n : all) {
    reports::Criterion& c = n.summary.verdicts[0].criteria[0];
    c.target = 100.0, c.lower = 99.0, c.upper = 130.0;
    c.actual = &n == &all[1] ? 109.0 : 99.1;
  }
  const auto figures = figures_of(history_section(all));
  for (const reports::Panel& p : figures.at("history-metrics").panels) {
    const Plot& plot = std::get<Plot>(p);
    if (!plot.title.ends_with("near its limit")) continue;
    EXPECT_NEAR(plot.series[0].y[0], -0.9, 1e-12);
    EXPECT_NEAR(plot.series[0].y[1], 0.3, 1e-12);
    return;
  }
  ADD_FAILURE() << "no panel of it";
}

TEST(HistoryFigures, ALongNightIsMarkedOnlyAtEqualWork) {
  std::vector<Night> all = made_up_nights(6);
  all.back().summary.wall_seconds = 90.0;
  auto work = figures_of(history_section(all)).at("history-work");
  EXPECT_NE(work.caption.find("This night was slower."), std::string::npos);
  EXPECT_NEAR(panel(work, 0).bands.at(0).upper[0], 1.2 * 60.02, 0.02);  // 20 % above the median of the nights before, 60.02 or so
  EXPECT_EQ(panel(work, 1).series.size(), 4u);
  EXPECT_DOUBLE_EQ(panel(work, 1).series[2].y.front(), 1.0);
  all.back().work.steps = 2000;
  work = figures_of(history_section(all)).at("history-work");
  EXPECT_NE(work.caption.find("This night was not slower."), std::string::npos);
  EXPECT_TRUE(panel(work, 0).bands.empty());  // no night before had as much work
  EXPECT_DOUBLE_EQ(panel(work, 1).series[2].y.front(), 0.5);
}

TEST(HistoryFigures, GapsLongHistoriesAndShortOnes) {
  std::vector<Night> all = made_up_nights(150);
  all[148].summary.verdicts[1].criteria.clear();
  const Plot jump = panel(figures_of(history_section(all)).at("history-metrics"), 0);
  ASSERT_EQ(jump.series[0].x.size(), 101u);
  EXPECT_TRUE(std::isnan(jump.series[0].y[99]));
  EXPECT_EQ(jump.bands.back().x[0], -5.0);  // four nights with a value
  EXPECT_TRUE(history_section(made_up_nights(1)).figures.empty());
  const auto two = figures_of(history_section(made_up_nights(2)));
  EXPECT_TRUE(panel(two.at("history-metrics"), 0).bands.empty());
}

TEST(HistoryFigures, AFailureComesBeforeWhatIsNearItsLimit) {
  std::vector<Night> all = made_up_nights(10);
  all.back() = made_up_night(9, 1000);
  reports::Verdict& failed = all.back().summary.verdicts[5];
  failed.state = failed.criteria[0].state = State::error;
  failed.criteria[0].actual = std::nan("");
  const std::vector<Trend> urgent = most_urgent(all);
  EXPECT_EQ(urgent.front().case_id, failed.case_id);
  EXPECT_EQ(panel(figures_of(history_section(all)).at("history-metrics"), 0).title, "ERROR: static/2: right");
}

TEST(HistoryPage, HasATileANightAndTheMetricThatLostMostFirst) {
  std::vector<Night> nights = made_up_nights(5);
  nights[1].summary.verdicts[0].state = State::fail;
  const reports::Report page = history_page(nights);
  ASSERT_EQ(page.nights.size(), 5u);
  EXPECT_EQ(page.nights[1].state, State::fail);
  EXPECT_EQ(page.nights[4].state, State::pass);
  EXPECT_EQ(page.findings, (std::vector<std::string>{"The last night, 2026-01-05T02:00:00Z: 12 of 12 passed. Nights: 5, of which 1 failed."}));
  // "jumps" goes from 1 to 5 of 10; the others stay where they are.
  const reports::Table& table = page.sections.front().tables.front();
  EXPECT_EQ(std::get<std::string>(table.rows[0][1].value), "jumps");
  EXPECT_NEAR(std::get<double>(table.rows[0][3].value), 50.0, 1e-9);
  EXPECT_NEAR(std::get<double>(table.rows[0][4].value), 40.0, 1e-9);
  EXPECT_EQ(std::get<reports::Spark>(table.rows[0][2].value).values.size(), 5u);
  // The median of an even number of nights is between two; of two criteria for one metric the tighter one counts.
  nights[0].summary.verdicts[1].criteria[0].actual = nights[2].summary.verdicts[1].criteria[0].actual = 103.0;
  for (Night& night : nights) {
    auto& criteria = night.summary.verdicts[1].criteria;
    criteria.push_back(criteria.front());
    criteria.back().lower = 0.0, criteria.back().upper = 200.0;
  }
  EXPECT_NEAR(std::get<double>(history_page(nights).sections.front().tables.front().rows[0][4].value), 30.0, 1e-9);
  // What is not measured any more comes first.
  nights[4].summary.verdicts[5].criteria[0].actual = std::nan("");
  const reports::Table again = history_page(nights).sections.front().tables.front();
  EXPECT_EQ(std::get<std::string>(again.rows[0][0].value), "static/2");
  EXPECT_NO_THROW(reports::render_html(page));
  EXPECT_NO_THROW(reports::render_html(history_page({made_up_night(0, 0)})));
}

}  // namespace
}  // namespace ddem::harness::nightly
