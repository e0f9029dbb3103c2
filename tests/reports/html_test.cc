// The whole report: well-formed, self-contained, ordered, small, deterministic.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <pugixml.hpp>
#include <set>
#include <stdexcept>

#include "reports/report.h"

namespace ddem::reports {
namespace {

Figure signals(const std::string& id, int samples) {
  Plot plot{.x = {.label = "time", .unit = "s"}, .y = {.label = "u", .unit = "m"}};
  for (const char* name : {"near", "far"}) {
    Series s{.name = name};
    for (int i = 0; i < samples; ++i) {
      s.x.push_back(i * 1e-9);
      s.y.push_back(1e-6 * std::sin(i * 12.9898) * std::sin(i * 78.233));  // jagged: the worst case for size
    }
    plot.series.push_back(s);
  }
  return {.id = id, .title = "Signals " + id, .caption = "See.", .panels = {plot, plot, plot, plot}};
}

Report sample() {
  return {.title = "Report <1>",
          .summary = {"A & B"},
          .headlines = {{"nu", "0.479", "closed form 0.479"}},
          .verdicts = {{.case_id = "a", .title = "A", .state = State::pass},
                       {.case_id = "b",
                        .title = "B",
                        .state = State::fail,
                        .reason = "<script>alert(1)</script>",
                        .criteria = {{.metric = "m",
                                      .actual = std::numeric_limits<double>::quiet_NaN(),
                                      .lower = 0,
                                      .upper = 1,
                                      .state = State::fail}},
                        .reproduce = "./ddem run 'b & c'"},
                       {.case_id = "c", .title = "C", .state = State::error}},
          .sections = {{.heading = "One",
                        .paragraphs = {"p"},
                        .figures = {signals("s", 100), signals("s", 100)},
                        .tables = {{.caption = "t",
                                    .columns = {{"name"}, {"value", "m"}},
                                    .rows = {{"x", 1}, {"y", 2.5e-9}, {"z", std::nan("")}}}}},
                       {.heading = "One"}},
          .provenance = {{"version", "1.0"}}};
}

class Page {
 public:
  explicit Page(const Report& report) : text(render_html(report)) {
    const auto result = document.load_string(text.c_str(), pugi::parse_default | pugi::parse_doctype);
    EXPECT_TRUE(result) << result.description() << " at "
                        << text.substr(static_cast<std::size_t>(result.offset), 80);
  }
  std::size_t count(const char* xpath) const { return document.select_nodes(xpath).size(); }
  std::string text;
  pugi::xml_document document;
};

TEST(Html, IsWellFormedAndEscaped) {
  const Page page(sample());
  EXPECT_EQ(page.text.rfind("<!DOCTYPE html>\n", 0), 0u);
  EXPECT_EQ(page.count("//script"), 1u);  // ours only
  EXPECT_STREQ(page.document.select_node("/html/head/title").node().text().get(), "Report <1>");
  EXPECT_STREQ(page.document.child("html").attribute("lang").value(), "en");
  for (const char* bad : {">nan", "nan<", "NaN", ">inf"})
    EXPECT_EQ(page.text.find(bad), std::string::npos) << bad;
}

TEST(Html, AFigureSaysWhichCommandOfWhichProgramMadeIt) {
  Report report = sample();
  report.sections[0].figures[0].made_by = "ddem validate --only one";
  report.provenance = {{"version", "1.0"}, {"commit", "0123abc with changes"}};
  EXPECT_NE(Page(report).text.find("Made by <code>ddem validate --only one</code> of version 1.0, commit 0123abc with changes."), std::string::npos);
  report.provenance = {{"version", "1.0"}, {"commit", "unknown"}};
  EXPECT_NE(Page(report).text.find("</code> of version 1.0.<"), std::string::npos);
  report.provenance.clear();
  EXPECT_NE(Page(report).text.find("Made by <code>ddem validate --only one</code>.<"), std::string::npos);
}

TEST(Html, NeedsNoNetwork) {
  const Page page(sample());
  EXPECT_EQ(page.count("//@src"), 0u);
  EXPECT_EQ(page.count("//link[not(starts-with(@href, 'data:'))]"), 0u);
  EXPECT_EQ(page.count("//a[not(starts-with(@href, 'data:') or starts-with(@href, '#'))]"), 0u);
  EXPECT_EQ(page.text.find("url("), std::string::npos);
  EXPECT_EQ(page.text.find("@import"), std::string::npos);
}

TEST(Html, VerdictsAreWorstFirstAndFailuresAreOpen) {
  const Page page(sample());
  std::vector<std::string> states;
  for (const auto& g : page.document.select_nodes("//details[@class='group']"))
    states.push_back(g.node().attribute("data-state").value());
  EXPECT_EQ(states, (std::vector<std::string>{"ERROR", "FAIL", "PASS"}));
  EXPECT_EQ(page.count("//details[@class='case']"), 3u);
  EXPECT_EQ(page.count("//details[@class='case'][@open]"), 2u);
  EXPECT_EQ(page.count("//details[@class='group'][@data-state='PASS'][@open]"), 0u);
  EXPECT_EQ(page.count("//div[@class='filter']/button"), 4u);
  EXPECT_NE(page.text.find("1 of 3 passed, 1 ERROR, 1 FAIL"), std::string::npos);
  EXPECT_NE(page.text.find("not measured"), std::string::npos);
}

TEST(Html, IdsAreUniqueAndReferencesResolve) {
  const Page page(sample());
  std::set<std::string> ids;
  for (const auto& n : page.document.select_nodes("//@id"))
    EXPECT_TRUE(ids.insert(n.attribute().value()).second) << n.attribute().value();
  for (const auto& n : page.document.select_nodes("//nav//a/@href"))
    EXPECT_TRUE(ids.count(n.attribute().value() + 1)) << n.attribute().value();
  for (const auto& n : page.document.select_nodes("//@aria-labelledby")) {
    const std::string both = n.attribute().value();
    EXPECT_TRUE(ids.count(both.substr(0, both.find(' ')))) << both;
  }
}

TEST(Html, HeadingsAreInOrderAndTableHeadersHaveScopes) {
  const Page page(sample());
  int level = 0;
  for (const auto& h : page.document.select_nodes("//h1|//h2|//h3|//h4")) {
    const int next = h.node().name()[1] - '0';
    EXPECT_LE(next, level + 1);
    level = next;
  }
  EXPECT_EQ(page.count("//h1"), 1u);
  EXPECT_EQ(page.count("//th[not(@scope)]"), 0u);
  EXPECT_EQ(page.count("//svg[@role='img'][not(title) or not(desc)]"), 0u);
}

TEST(Html, NumbersAreAlignedAndMissingOnesAreDashes) {
  const Page page(sample());
  const auto cells = page.document.select_nodes("//table[caption='t']/tbody/tr/td[@class='n']");
  ASSERT_EQ(cells.size(), 3u);
  EXPECT_STREQ(cells[1].node().text().get(), "2.5×10⁻⁹");
  EXPECT_STREQ(cells[2].node().text().get(), "–");
}

TEST(Html, TheSameReportGivesTheSameBytes) {
  EXPECT_EQ(render_html(sample()), render_html(sample()));
}

Report with_signals(int figures) {
  Section section{.heading = "Signals"};
  for (int i = 0; i < figures; ++i) section.figures.push_back(signals(std::to_string(i), 20000));
  return {.title = "long", .sections = {section}};
}

TEST(Html, LongSignalsStayBelowTheLimit) {
  const Page few(with_signals(1));
  const std::size_t each = few.text.size();
  EXPECT_EQ(few.count("//div[@class='drawing narrow']"), 1u);
  EXPECT_NE(few.text.find("long series are thinned"), std::string::npos);
  const int many = 17;
  ASSERT_GT(each * many, kReportSizeLimit);  // only thinner data can bring these below the limit
  const Page page(with_signals(many));
  EXPECT_LT(page.text.size(), kReportSizeLimit);
  EXPECT_EQ(page.count("//figure"), static_cast<std::size_t>(many));
}

TEST(Html, AnEmptyReportIsAPage) {
  EXPECT_EQ(Page(Report{}).count("//h1"), 1u);
}

TEST(Html, RowsLongerThanTheHeaderAreRefused) {
  Report report = sample();
  report.sections[0].tables[0].rows.push_back({1, 2, 3});
  EXPECT_THROW(render_html(report), std::invalid_argument);
}

}  // namespace
}  // namespace ddem::reports
