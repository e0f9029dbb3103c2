// A report kept as JSON and arrays is drawn to the same bytes; what is not a report is refused by the name of
// what is wrong.
#include "reports/report_json.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "reports/svg.h"
#include "tests/reports/full_report.h"

namespace ddem::reports {
namespace {

/// Arrays apart from the document, as a file keeps them.
struct Kept {
  std::vector<std::vector<double>> arrays;
  Json document;
};

Kept kept(const Report& report) {
  Kept k;
  k.document = to_json(report, [&](const std::vector<double>& values) {
    k.arrays.push_back(values);
    return k.arrays.size() - 1;
  });
  return k;
}

Report restored(const Kept& k) {
  // Through text, as a file is.
  return report_from_json(Json::parse(k.document.dump()),
                          [&](const Json& place) { return k.arrays.at(place.get<std::size_t>()); });
}

TEST(ReportJson, IsDrawnToTheSameBytes) {
  const Report report = test::full_report();
  const Report same = restored(kept(report));
  EXPECT_EQ(render_html(same), render_html(report));
  EXPECT_EQ(render_html(same, {.plotly = "var Plotly;"}), render_html(report, {.plotly = "var Plotly;"}));
  const auto &before = report.sections[0].figures, &after = same.sections[0].figures;
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_EQ(render_svg(after[i]), render_svg(before[i])) << before[i].id;
}

TEST(ReportJson, KeepsNumbersExactlyAndWhatIsNotOne) {
  const Report same = restored(kept(test::full_report()));
  const Plot& plot = std::get<Plot>(same.sections[0].figures[0].panels[0]);
  EXPECT_EQ(plot.series[0].x[3], 0.1 * 3);  // which is not 0.3
  EXPECT_TRUE(std::isnan(plot.series[0].y[4]));
  EXPECT_EQ(plot.references[1].direction, Direction::vertical);
  EXPECT_EQ(same.verdicts[2].criteria[0].upper, 1e-9);
  EXPECT_FALSE(std::isfinite(same.verdicts[2].criteria[0].actual));
  EXPECT_EQ(same.verdicts[0].facets[1].second, "random");
  EXPECT_EQ(std::get<Strip>(same.sections[0].figures[3].panels[0]).fields[1].values.size(), 12u * 120u);
}

TEST(ReportJson, WhatIsNotAReportIsRefused) {
  const auto refused = [](const Json& document) -> std::string {
    try {
      report_from_json(document, [](const Json&) { return std::vector<double>(); });
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(refused(Json::array()), "");
  EXPECT_NE(refused({{"title", 3}}).find("title"), std::string::npos);
  EXPECT_NE(refused({{"verdicts", Json::array({{{"state", "splendid"}}})}}).find("splendid"),
            std::string::npos);
  EXPECT_NE(refused({{"sections", {{"heading", "not a list"}}}}).find("sections"), std::string::npos);
  const Json panel = {{"type", "hologram"}};
  EXPECT_NE(
      refused({{"sections", Json::array({{{"figures", Json::array({{{"panels", Json::array({panel})}}})}}})}})
          .find("hologram"),
      std::string::npos);
}

}  // namespace
}  // namespace ddem::reports
