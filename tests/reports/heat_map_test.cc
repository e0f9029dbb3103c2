// Heat maps: where cells lie, which colours they have, what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <pugixml.hpp>
#include <stdexcept>
#include <string>

#include "reports/color.h"
#include "reports/figure_data.h"
#include "reports/heat_map.h"
#include "reports/svg.h"

namespace ddem::reports {
namespace {

HeatMap two_by_two() {
  return {.x = {1.0, 3.0}, .y = {10.0, 1000.0}, .value = {-0.1, 0.0, 1e-9, 0.1}, .value_axis = {.label = "growth", .limits = Limits{1e-5, 0.1}},
          .scale = ColorScale::signed_log};
}

Figure figure_of(const HeatMap& map) {
  return {.id = "map", .title = "A map", .panels = {Plot{.x = {.label = "a"}, .y = {.label = "b", .scale = Scale::log}, .map = map}}};
}

/// Fill colour and path data of the cells.
std::vector<std::pair<std::string, std::string>> cells_of(const Figure& figure) {
  pugi::xml_document document;
  EXPECT_TRUE(document.load_string(render_svg(figure).c_str()));
  std::vector<std::pair<std::string, std::string>> cells;
  for (const pugi::xpath_node& node : document.select_nodes("//g[@class='map']/path")) {
    cells.emplace_back(node.node().attribute("fill").value(), node.node().attribute("d").value());
  }
  return cells;
}

TEST(HeatMap, EndsHalfACellBeyondTheOuterCentres) {
  EXPECT_DOUBLE_EQ(map_extent({1.0, 3.0}, Scale::linear).lower, 0.0);
  EXPECT_DOUBLE_EQ(map_extent({1.0, 3.0}, Scale::linear).upper, 4.0);
  EXPECT_NEAR(map_extent({10.0, 1000.0}, Scale::log).lower, 1.0, 1e-12);
  EXPECT_NEAR(map_extent({10.0, 1000.0}, Scale::log).upper, 1e4, 1e-8);
}

TEST(HeatMap, SignedColoursHaveWhiteForWhatIsSmall) {
  const auto cells = cells_of(figure_of(two_by_two()));
  ASSERT_EQ(cells.size(), 3u);
  EXPECT_EQ(cells[0].first, hex(diverging(-1.0)));
  EXPECT_EQ(cells[1].first, hex(diverging(0.0)));  // both small ones in one path
  EXPECT_EQ(cells[2].first, hex(diverging(1.0)));
  const auto count = [](const std::string& d) { return std::count(d.begin(), d.end(), 'M'); };
  EXPECT_EQ(count(cells[0].second), 1);
  EXPECT_EQ(count(cells[1].second), 2);
}

TEST(HeatMap, NeighboursOfOneColourAreOneRectangle) {
  HeatMap map = two_by_two();
  map.value = {0.1, 0.1, 0.0, std::numeric_limits<double>::quiet_NaN()};
  const auto cells = cells_of(figure_of(map));
  ASSERT_EQ(cells.size(), 3u);
  EXPECT_EQ(cells[0].first, "#c4c4c4");  // no value
  EXPECT_EQ(std::count(cells[2].second.begin(), cells[2].second.end(), 'M'), 1);
  EXPECT_NE(render_svg(figure_of(map)).find("1 cell without a value is grey."), std::string::npos);
}

TEST(HeatMap, IsInTheCsv) {
  const std::string csv = figure_csv(figure_of(two_by_two()), 100).text;
  EXPECT_NE(csv.find("panel,kind,name,x,y,value\n"), std::string::npos);
  EXPECT_NE(csv.find("1,cell,growth,3,1000,0.1\n"), std::string::npos);
}

TEST(HeatMap, IsChecked) {
  HeatMap short_of_values = two_by_two(), unordered = two_by_two(), without_limits = two_by_two(), zero_limit = two_by_two();
  short_of_values.value.pop_back();
  unordered.x = {3.0, 1.0};
  without_limits.value_axis.limits.reset();
  zero_limit.value_axis.limits = Limits{0.0, 1.0};  // has no place on a logarithmic bar
  for (const HeatMap& map : {short_of_values, unordered, without_limits, zero_limit}) EXPECT_THROW(render_svg(figure_of(map)), std::invalid_argument);
  EXPECT_NO_THROW(render_svg(figure_of(two_by_two())));
}

TEST(DivergingColours, AreBlueWhiteAndRed) {
  EXPECT_EQ(hex(diverging(0.0)), "#f7f7f7");
  EXPECT_EQ(hex(diverging(-2.0)), hex(diverging(-1.0)));
  EXPECT_GT(diverging(-0.7)[2], diverging(-0.7)[0]);
  EXPECT_GT(diverging(0.7)[0], diverging(0.7)[2]);
}

}  // namespace
}  // namespace ddem::reports
