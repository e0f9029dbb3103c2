// What the page's script is given: the same data, axes and colours as the SVG, in markup that nothing ends
// early.
#include "reports/interactive.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <stdexcept>

#include "reports/color.h"
#include "reports/packed.h"
#include "tests/reports/full_report.h"

namespace ddem::reports {
namespace {

using nlohmann::json;

const Figure& figure(const Report& report, std::size_t i) {
  return report.sections[0].figures[i];
}

/// Half a unit of the last of 16 significant bits.
constexpr double kPackedError = 1.0 / 65536.0;

/// Of base64 without padding, decoded by hand.
std::vector<unsigned> bytes_of(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<unsigned> bytes;
  for (std::size_t i = 0; i + 4 <= text.size(); i += 4) {
    unsigned group = 0;
    for (std::size_t k = 0; k < 4; ++k) group = group << 6 | static_cast<unsigned>(digits.find(text[i + k]));
    for (const int shift : {16, 8, 0}) bytes.push_back(group >> shift & 255u);
  }
  return bytes;
}

/// (-1)^sign 2^(exponent - 127) (1 + fraction / 2^15) of 1, 8 and 15 bits.
std::vector<double> unpacked(const std::string& text) {
  const std::vector<unsigned> bytes = bytes_of(text);
  std::vector<double> values;
  for (std::size_t i = 0; i + 3 <= bytes.size(); i += 3) {
    const unsigned bits = bytes[i] << 16 | bytes[i + 1] << 8 | bytes[i + 2];
    const int exponent = static_cast<int>(bits >> 15 & 255u);
    const double size = exponent == 0     ? 0.0
                        : exponent == 255 ? std::nan("")
                                          : std::ldexp(1.0 + (bits & 0x7fffu) / 32768.0, exponent - 127);
    values.push_back(bits >> 23 != 0 ? -size : size);
  }
  return values;
}

TEST(Interactive, SeriesHaveTheirNumbersAndTheColoursOfTheSvg) {
  const Report report = test::full_report();
  const json live = json::parse(live_figure(figure(report, 0), 100));
  const json& panel = live["figure"]["panels"][0];
  const json& measured = panel["series"][0];
  const json& y = live["arrays"][measured["y"].get<std::size_t>()];
  ASSERT_EQ(y.size(), 11u);
  EXPECT_EQ(y[3], 2000.0 + 300.0 * 0.3 + 20.0);
  EXPECT_TRUE(y[4].is_null());
  // k_t/k_n is evenly spaced, and the same array for all three.
  const json& x = live["arrays"][measured["x"].get<std::size_t>()];
  EXPECT_EQ(x["count"], 11);
  EXPECT_NEAR(x["step"].get<double>(), 0.1, 1e-15);
  EXPECT_EQ(panel["series"][1]["x"], measured["x"]);
  EXPECT_EQ(panel["bands"][0]["x"], measured["x"]);
  const json& styles = live["figure"]["styles"];
  EXPECT_EQ(styles[measured["style"].get<std::size_t>()]["color"], color_hex(Color::blue));
  EXPECT_EQ(panel["bands"][0]["style"], measured["style"]);
  EXPECT_EQ(styles[panel["series"][1]["style"].get<std::size_t>()]["dash"], "dashed");
  EXPECT_EQ(panel["ymarks"]["title"], "velocity (m/s)");
  EXPECT_TRUE(live["figure"]["panels"][1]["xmarks"]["log"]);
}

TEST(Interactive, LongSignalsAreThinnedAndKeepTheirCrest) {
  const Report report = test::full_report();
  const json live = json::parse(live_figure(figure(report, 1), 400));
  EXPECT_TRUE(live["figure"]["thinned"]);
  const json& series = live["figure"]["panels"][0]["series"][0];
  const std::vector<double> y = unpacked(live["arrays"][series["y"].get<std::size_t>()]["packed"]);
  EXPECT_LE(y.size(), 400u);
  EXPECT_GE(y.size(), 200u);
  const auto& all = std::get<Plot>(figure(report, 1).panels[0]).series[0].y;
  const double crest = *std::max_element(all.begin(), all.end());
  EXPECT_NEAR(*std::max_element(y.begin(), y.end()), crest, kPackedError * crest);
  EXPECT_EQ(live["figure"]["panels"][0]["xmarks"]["exponent"], -6);
}

TEST(Interactive, FieldsOverTimeAreLevelsOfTheirLimits) {
  const Report report = test::full_report();
  const json live = json::parse(live_figure(figure(report, 3), 400));
  const json& field = live["figure"]["panels"][0]["fields"][0];
  EXPECT_TRUE(field["signed"]);
  EXPECT_FALSE(live["figure"]["panels"][0]["fields"][1]["signed"]);
  const std::string bytes = field["bytes"];
  ASSERT_EQ(bytes.size(), 4u * 12 * 120 / 3);
  // The first disc at rest, u = 1e-8 sin(900 * 0.25e-3), on 0 .. 254 from -1e-8 to 1e-8.
  const std::vector<unsigned> levels = bytes_of(bytes);
  EXPECT_EQ(levels[0], static_cast<unsigned>(std::lround(127.0 * (1.0 + std::sin(900.0 * 2.5e-4)))));
  EXPECT_EQ(levels[3 * 120], 255u);  // the frame whose first disc has no value
}

TEST(Interactive, ManyNumbersArePackedWithinASixtiethOfAPixel) {
  std::vector<double> values = {0.0, -0.0, 1.0, -1.0, 1.0 - 1e-9, 1e-37, -1e38, std::nan(""), std::numeric_limits<double>::infinity()};
  for (int k = 0; k < 1000; ++k) values.push_back(std::pow(-1.0, k) * std::pow(10.0, -30.0 + 0.0613 * k));
  const std::vector<double> back = unpacked(packed_numbers(values).value());
  ASSERT_EQ(back.size(), values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i]))
      EXPECT_NEAR(back[i], values[i], kPackedError * std::abs(values[i]));
    else
      EXPECT_TRUE(std::isnan(back[i]));
  }
  EXPECT_EQ(unpacked(packed_numbers({1.0, 1e-40}).value())[1], 0.0);
  EXPECT_FALSE(packed_numbers({1e-25, 1e-38}));  // within the digits of a double
  EXPECT_FALSE(packed_numbers({1e39}));
}

TEST(Interactive, Base64) {
  EXPECT_EQ(base64({}), "");  // RFC 4648, section 10
  EXPECT_EQ(base64({'f'}), "Zg==");
  EXPECT_EQ(base64({'f', 'o'}), "Zm8=");
  EXPECT_EQ(base64({'f', 'o', 'o', 'b', 'a', 'r'}), "Zm9vYmFy");
}

/// Text inside <script> of the page, read as XML.
TEST(Interactive, PageIsWellFormedWithAnyLibraryAndKeepsItsDrawings) {
  const std::string library = "var Plotly = {a: 1 < 2 && 3};";
  const std::string page = render_html(test::full_report(), {.plotly = library});
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(page.c_str(), pugi::parse_default | pugi::parse_doctype));
  EXPECT_NE(page.find(library), std::string::npos);
  EXPECT_EQ(document.select_nodes("//figure").size(), 5u);
  EXPECT_EQ(document.select_nodes("//figure[script]/div[@class='drawing still']/svg").size(), 4u);
  EXPECT_EQ(document.select_nodes("//figure[not(script)]/div/svg").size(), 1u);  // a strip at rest
  EXPECT_EQ(document.select_nodes("//*[@src]").size(), 0u);
  for (const auto& script : document.select_nodes("//script[@type='application/json']"))
    EXPECT_TRUE(json::accept(script.node().text().get()));
}

TEST(Interactive, LibraryThatEndsItsScriptIsRefused) {
  EXPECT_THROW(render_html(test::full_report(), {.plotly = "x = '</script>'"}), std::invalid_argument);
  EXPECT_THROW(render_html(test::full_report(), {.plotly = "a[b[1]]>2"}), std::invalid_argument);
}

}  // namespace
}  // namespace ddem::reports
