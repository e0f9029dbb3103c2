// What is drawn, read back from the SVG.
#include "reports/svg.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <pugixml.hpp>
#include <stdexcept>

#include "reports/figure_data.h"
#include "reports/geometry.h"
#include "reports/strip.h"
#include "reports/text.h"

namespace ddem::reports {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

class Drawing {
 public:
  explicit Drawing(const Figure& figure) : text(render_svg(figure)) {
    const pugi::xml_parse_result result = document.load_string(text.c_str());
    EXPECT_TRUE(result) << result.description() << " at " << result.offset;
  }
  std::vector<pugi::xml_node> all(const std::string& css_class) const {
    std::vector<pugi::xml_node> nodes;
    for (const auto& n : document.select_nodes(("//*[@class='" + css_class + "']").c_str()))
      nodes.push_back(n.node());
    return nodes;
  }
  Rect area(std::size_t i = 0) const {
    const pugi::xml_node n = all("area").at(i);
    const auto number = [&](const char* name) { return n.attribute(name).as_double(); };
    return {number("x"), number("y"), number("width"), number("height")};
  }

  std::string text;
  pugi::xml_document document;
};

// All vertices of path data as path_data() writes it.
std::vector<Polyline> vertices(const std::string& data) {
  std::vector<Polyline> lines;
  const char* at = data.c_str();
  while (*at != '\0') {
    char* end = nullptr;
    if (*at == 'M') lines.emplace_back();
    const bool start = *at == 'M';
    if (*at == 'z') {
      ++at;
      continue;
    }
    if (*at == 'M' || *at == 'l' || *at == ' ') ++at;
    const double x = std::strtod(at, &end), y = std::strtod(end, &end);
    at = end;
    const Point origin = start ? Point{} : lines.back().back();
    lines.back().push_back({origin.x + x, origin.y + y});
  }
  return lines;
}

Figure single(Plot plot) {
  return {.id = "f", .title = "T", .caption = "C", .panels = {std::move(plot)}};
}

void expect_inside(const Rect& area, Point p) {
  constexpr double rounding = 0.051;  // a tenth of a pixel, to the nearest
  EXPECT_TRUE(p.x >= area.left - rounding && p.x <= area.right() + rounding && p.y >= area.top - rounding &&
              p.y <= area.bottom() + rounding)
      << p.x << " " << p.y;
}

void expect_all_inside(const Drawing& drawing) {
  for (const char* kind : {"line", "band", "error"})
    for (const pugi::xml_node n : drawing.all(kind))
      for (const Polyline& line : vertices(n.attribute("d").value()))
        for (const Point& p : line) expect_inside(drawing.area(), p);
  for (const auto& n : drawing.document.select_nodes("//g[@class='markers']/circle"))
    expect_inside(drawing.area(),
                  {n.node().attribute("cx").as_double(), n.node().attribute("cy").as_double()});
}

void expect_no_bad_number(const std::string& text) {
  for (const char* bad : {"nan", "NaN", "inf\"", "-inf", "Infinity"})
    EXPECT_EQ(text.find(bad), std::string::npos) << bad;
}

TEST(Svg, PointsAreWhereTheirValuesSay) {
  Plot plot{.x = {.limits = Limits{0, 10}},
            .y = {.limits = Limits{-1, 1}},
            .series = {{.name = "s", .x = {0, 2.5, 10}, .y = {-1, 0, 1}}}};
  const Drawing drawing(single(plot));
  const Rect a = drawing.area();
  const auto lines = vertices(drawing.all("line").at(0).attribute("d").value());
  ASSERT_EQ(lines.size(), 1u);
  ASSERT_EQ(lines[0].size(), 3u);
  EXPECT_NEAR(lines[0][0].x, a.left, 0.05 + 1e-9);
  EXPECT_NEAR(lines[0][0].y, a.bottom(), 0.05 + 1e-9);
  EXPECT_NEAR(lines[0][1].x, a.left + a.width / 4, 0.05 + 1e-9);
  EXPECT_NEAR(lines[0][1].y, a.top + a.height / 2, 0.05 + 1e-9);
  EXPECT_NEAR(lines[0][2].x, a.right(), 0.05 + 1e-9);
  EXPECT_NEAR(lines[0][2].y, a.top, 0.05 + 1e-9);
}

TEST(Svg, TicksAreWhereTheirLabelsSay) {
  Plot plot{.x = {.limits = Limits{0, 1e-5}}, .y = {.limits = Limits{0, 1}}};
  plot.x.unit = "s";
  const Drawing drawing(single(plot));
  const Rect a = drawing.area();
  const pugi::xml_node ticks = drawing.all("xticks").at(0);
  for (const pugi::xml_node t : ticks)
    EXPECT_NEAR(t.attribute("x").as_double(), a.left + a.width * t.text().as_double() / 10.0, 0.01);
  EXPECT_EQ(drawing.all("xtitle").at(0).text().get(), std::string("µs"));
}

TEST(Svg, EverythingIsInsideThePlotArea) {
  Series wild{.name = "wild", .kind = SeriesKind::line_markers};
  Band band{.name = "band"};
  for (int i = 0; i < 500; ++i) {
    wild.x.push_back(i * 0.01);
    wild.y.push_back(std::tan(i * 0.1) * std::exp(i * 0.01));
    wild.error.push_back(std::abs(std::sin(i)) * 3);
    band.x.push_back(i * 0.01);
    band.lower.push_back(-i * 0.1);
    band.upper.push_back(i * 0.2);
  }
  Plot plot{.series = {wild}, .bands = {band}};
  expect_all_inside(Drawing(single(plot)));
  plot.y.limits = Limits{-1, 2};  // most is cut off now
  plot.x.limits = Limits{1.005, 3.3};
  const Drawing cut(single(plot));
  expect_all_inside(cut);
  EXPECT_NE(cut.text.find("points are outside the range shown"), std::string::npos);
}

TEST(Svg, GapsStayGaps) {
  const Drawing drawing(
      single({.series = {{.name = "s", .x = {0, 1, 2, 3, 4, kInf}, .y = {0, 1, kNan, 5, 4, 2}}}}));
  EXPECT_EQ(vertices(drawing.all("line").at(0).attribute("d").value()).size(), 2u);
  expect_no_bad_number(drawing.text);
  EXPECT_NE(drawing.text.find("2 missing values are gaps."), std::string::npos);
}

TEST(Svg, APointBetweenGapsIsVisible) {
  const Drawing drawing(single({.series = {{.name = "s", .x = {0, 1, 2}, .y = {kNan, 1, kNan}}}}));
  EXPECT_EQ(drawing.all("isolated").size(), 1u);
}

TEST(Svg, LogarithmicAxisLeavesOutWhatIsNotPositiveAndSaysSo) {
  Plot plot{.x = {.scale = Scale::log},
            .y = {.scale = Scale::log},
            .series = {{.name = "s",
                        .kind = SeriesKind::markers,
                        .x = {0, 1, 10, 100},
                        .y = {1, -1, 1e-3, 1},
                        .error = {1, 1, 1, 1}}}};
  const Drawing drawing(single(plot));
  EXPECT_EQ(drawing.document.select_nodes("//g[@class='markers']/circle").size(), 2u);
  EXPECT_NE(drawing.text.find("2 values that are not positive"), std::string::npos);
  expect_all_inside(drawing);
  expect_no_bad_number(drawing.text);
}

TEST(Svg, PeaksOfLongSignalsSurviveInASmallFile) {
  Series s{.name = "s"};
  for (int i = 0; i < 200000; ++i) {
    s.x.push_back(i);
    s.y.push_back(0.01 * std::sin(i * 1.7));
  }
  s.y[123456] = 1.0;
  Plot plot{.y = {.limits = Limits{-1, 1}}, .series = {s}};
  const Drawing drawing(single(plot));
  EXPECT_LT(drawing.text.size(), 100000u);
  double top = 1e9;
  for (const Polyline& line : vertices(drawing.all("line").at(0).attribute("d").value()))
    for (const Point& p : line) top = std::min(top, p.y);
  EXPECT_NEAR(top, drawing.area().top, 0.05 + 1e-9);
}

TEST(Svg, UserTextIsEscapedEverywhere) {
  const std::string evil = "<b>&\"' \xFF</text>";
  Plot plot{.title = evil,
            .x = {.label = evil, .unit = evil},
            .y = {.label = evil, .unit = evil},
            .series = {{.name = evil, .x = {0, 1}, .y = {0, 1}}},
            .references = {{.value = 0.5, .label = evil}},
            .picks = {{.x = 0.5, .y = 0.5, .label = evil, .series = evil}}};
  Strip strip{.title = evil,
              .x = {0},
              .y = {0},
              .radius = {1},
              .value = {1},
              .value_axis = {.label = evil},
              .probes = {{0, 0, evil}}};
  const Drawing drawing({.id = evil, .title = evil, .caption = evil, .panels = {plot, strip}});
  EXPECT_EQ(drawing.document.select_nodes("//b").size(), 0u);
  EXPECT_EQ(drawing.document.child("svg").child("title").text().get(),
            std::string("<b>&\"' \xEF\xBF\xBD</text>"));
}

TEST(Svg, DegenerateDataGiveSensibleDrawings) {
  const std::vector<Series> cases = {
      {.name = "empty"},
      {.name = "single", .kind = SeriesKind::markers, .x = {1}, .y = {2}},
      {.name = "equal", .x = {1, 1, 1}, .y = {3, 3, 3}},
      {.name = "huge", .x = {-1e300, 1e300}, .y = {1e-300, 1e300}},
      {.name = "overflow", .x = {-1.7e308, 1.7e308}, .y = {1, 2}},
      {.name = "tiny", .x = {0, 5e-324}, .y = {1e-310, 2e-310}},
      {.name = "all missing", .x = {kNan, kInf}, .y = {kNan, kNan}, .error = {kNan, -1}},
      {.name = "offset", .x = {0, 1}, .y = {1e16, 1e16 + 2}},
  };
  for (const Series& s : cases)
    for (const Scale scale : {Scale::linear, Scale::log}) {
      const Drawing drawing(single({.x = {.scale = scale}, .y = {.scale = scale}, .series = {s}}));
      expect_no_bad_number(drawing.text);
      expect_all_inside(drawing);
      EXPECT_FALSE(drawing.all("xticks").at(0).first_child().empty()) << s.name;
    }
  expect_no_bad_number(Drawing({.id = "no panels"}).text);
  expect_no_bad_number(Drawing({.panels = {Strip{}}}).text);
}

TEST(Svg, LegendNamesEverySeriesOnceAndCoversNoPanel) {
  const Plot plot{
      .series = {{.name = "a", .x = {0, 1}, .y = {0, 1}}, {.name = "b", .x = {0, 1}, .y = {1, 0}}}};
  const Drawing drawing({.id = "f", .panels = {plot, plot, plot, plot}});
  const auto texts = drawing.document.select_nodes("//g[@class='legend']/text");
  ASSERT_EQ(texts.size(), 2u);
  for (const auto& t : texts) EXPECT_LT(t.node().attribute("y").as_double(), drawing.area(0).top);
  EXPECT_EQ(drawing.all("area").size(), 4u);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(drawing.area(i).overlaps(drawing.area(j)));
  EXPECT_DOUBLE_EQ(drawing.area(0).top, drawing.area(1).top);
  EXPECT_DOUBLE_EQ(drawing.area(0).left, drawing.area(2).left);
  // The same name has the same colour in every panel.
  const auto lines = drawing.all("line");
  EXPECT_STREQ(lines[0].attribute("stroke").value(), lines[2].attribute("stroke").value());
  EXPECT_STRNE(lines[0].attribute("stroke").value(), lines[1].attribute("stroke").value());
}

TEST(Svg, LongTitlesOfPanelsStayBesideEachOther) {
  const Series line{.x = {0.0, 1.0}, .y = {0.0, 1.0}};
  const Plot named{.title = "REGRESSED: long-wave/random/lagged-normal/kt0.30: P velocity by correlation over that of S0", .series = {line}};
  const Plot brief{.title = "brief", .series = {line}};
  const Drawing drawing({.id = "titles", .panels = {named, named, brief}});
  const std::vector<pugi::xml_node> titles = drawing.all("ptitle");
  ASSERT_GE(titles.size(), 5u);
  for (const pugi::xml_node& t : titles) {
    const double left = t.attribute("x").as_double(), right = left + text_width(t.text().get(), t.attribute("font-size").as_double());
    EXPECT_LT(right, left < drawing.area(1).left - 1.0 ? drawing.area(1).left : 860.0);
    EXPECT_TRUE(std::none_of(titles.begin(), titles.end(), [&](const pugi::xml_node& other) {
      return other != t && other.attribute("x").as_double() == left && other.attribute("y").as_double() == t.attribute("y").as_double();
    }));
  }
  EXPECT_EQ(drawing.area(0).top, drawing.area(1).top);
  EXPECT_EQ(drawing.area(0).height, drawing.area(2).height);
}

TEST(Svg, StripHasEqualAspectRatioAndAllItsDiscs) {
  Strip strip{.value_axis = {.label = "u", .unit = "m"}};
  for (int i = 0; i < 62; ++i)
    for (int j = 0; j < 11; ++j) {
      strip.x.push_back(i * 2.0e-4);
      strip.y.push_back(j * 2.0e-4);
      strip.radius.push_back(1e-4);
      strip.value.push_back(i == 0 && j == 0 ? kNan : i * 1e-8);
    }
  strip.probes = {{2e-3, 2e-4, "A"}, {2e-3, 2e-3, "B"}};
  const Drawing drawing({.id = "s", .panels = {strip}});
  const auto discs = drawing.document.select_nodes("//g[@class='discs']//circle");
  ASSERT_EQ(discs.size(), 682u);
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
  for (const auto& d : discs) {
    left = std::min(left, d.node().attribute("cx").as_double());
    right = std::max(right, d.node().attribute("cx").as_double());
    top = std::min(top, d.node().attribute("cy").as_double());
    bottom = std::max(bottom, d.node().attribute("cy").as_double());
  }
  EXPECT_NEAR((right - left) / (bottom - top), 61.0 / 10.0, 1e-3);  // coordinates have two decimals
  EXPECT_EQ(drawing.all("probe").size(), 2u);
  EXPECT_NE(drawing.text.find("1 disc without a value is grey."), std::string::npos);
}

TEST(Svg, VeryManyDiscsAreThinnedAndTheReaderIsTold) {
  Strip strip;
  for (int i = 0; i < 50001; ++i) {
    strip.x.push_back(i % 300);
    strip.y.push_back(i / 300);
    strip.radius.push_back(0.5);
  }
  EXPECT_LE(discs_drawn(strip), kMaxDiscs);
  const Drawing drawing({.id = "s", .panels = {strip}});
  EXPECT_EQ(drawing.document.select_nodes("//g[@class='discs']//circle").size(), discs_drawn(strip));
  EXPECT_NE(drawing.text.find("of 50001 discs are drawn"), std::string::npos);
}

TEST(Svg, WrongFiguresAreRefusedByName) {
  const auto message = [](const Figure& f) {
    try {
      render_svg(f);
    } catch (const std::invalid_argument& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(message(single({.series = {{.name = "s", .x = {1, 2}, .y = {1}}}})),
            "figure 'f': series 's' has 1 values of y for 2 of x");
  EXPECT_NE(message(single({.x = {.limits = Limits{1, 1}}})).find("lower < upper"), std::string::npos);
  EXPECT_NE(message(single({.x = {.limits = Limits{1e16, 1e16 + 2}}})).find("limits"), std::string::npos);
  EXPECT_NE(message(single({.x = {.scale = Scale::log, .limits = Limits{0, 1}}})).find("positive"),
            std::string::npos);
  EXPECT_NE(message({.panels = {Strip{.x = {0}, .y = {0}, .radius = {0}}}}).find("disc 0"),
            std::string::npos);
}

TEST(Svg, TheSameFigureGivesTheSameBytes) {
  const Figure f =
      single({.series = {{.name = "s", .x = {0, 1, 2}, .y = {0.1, 0.7, 0.3}, .error = {0.1, 0.1, 0.1}}}});
  EXPECT_EQ(render_svg(f), render_svg(f));
}

TEST(FigureData, CsvIsTidyQuotedAndWithoutNan) {
  const Figure f = single({.title = "a, \"b\"",
                           .series = {{.name = "s", .x = {0, 1}, .y = {0.5, kNan}, .error = {0.25, 0.25}}},
                           .references = {{.value = 0.125, .label = "limit"}}});
  const Csv csv = figure_csv(f, 100);
  EXPECT_FALSE(csv.thinned);
  EXPECT_EQ(csv.text,
            "panel,kind,name,x,y,error\n"
            "\"a, \"\"b\"\"\",series,s,0,0.5,0.25\n"
            "\"a, \"\"b\"\"\",series,s,1,,0.25\n"
            "\"a, \"\"b\"\"\",reference,limit,,0.125,\n");
}

TEST(FigureData, ThinnedCsvKeepsTheExtremesAndItsSize) {
  Series s{.name = "s"};
  for (int i = 0; i < 100000; ++i) {
    s.x.push_back(i);
    s.y.push_back(std::sin(i * 0.7));
  }
  s.y[31415] = 42.5;
  const Csv csv = figure_csv(single({.series = {s}}), 1000);
  EXPECT_TRUE(csv.thinned);
  EXPECT_LE(std::count(csv.text.begin(), csv.text.end(), '\n'), 1001 + 4);
  EXPECT_NE(csv.text.find("s,31415,42.5\n"), std::string::npos);
}

TEST(FigureData, SeriesWithTheSameXShareATable) {
  const std::vector<double> x = {0, 1, 2};
  const auto tables = data_tables(single({.x = {.label = "ratio"},
                                          .series = {{.name = "a", .x = x, .y = x},
                                                     {.name = "b", .x = x, .y = x, .error = x},
                                                     {.name = "c", .x = {7}, .y = {8}}}}),
                                  60);
  ASSERT_EQ(tables.size(), 2u);
  EXPECT_EQ(tables[0].columns.size(), 4u);
  EXPECT_EQ(tables[0].rows.size(), 3u);
  EXPECT_EQ(tables[1].rows.size(), 1u);
}

}  // namespace
}  // namespace ddem::reports
