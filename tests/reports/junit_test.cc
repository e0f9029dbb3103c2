// Verdicts in words and as JUnit XML.
#include "reports/junit.h"

#include <gtest/gtest.h>

#include <limits>
#include <pugixml.hpp>

namespace ddem::reports {
namespace {

Criterion speed(State state) {
  return {.metric = "wave speed",
          .actual = 2290,
          .target = 2050,
          .lower = 1900,
          .upper = 2200,
          .unit = "m/s",
          .derivation = "static stiffness",
          .state = state};
}

std::vector<Verdict> one_of_each() {
  std::vector<Verdict> verdicts;
  for (const State state : {State::pass, State::skipped, State::fail, State::unstable_as_expected,
                            State::error, State::regressed, State::unstable, State::no_baseline, State::missing}) {
    Verdict v{
        .case_id = std::string(to_string(state)), .title = "t", .state = state, .reason = "because <\x01>"};
    if (is_failure(state)) v.criteria = {speed(state)};
    v.reproduce = "./ddem run \"a & b.toml\"";
    v.seconds = 0.25;
    verdicts.push_back(v);
  }
  return verdicts;
}

TEST(Junit, CountsAndMessagesAreRight) {
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(render_junit("default \"<suite>\"", one_of_each()).c_str()));
  const pugi::xml_node suite = document.child("testsuites").child("testsuite");
  EXPECT_STREQ(suite.attribute("name").value(), "default \"<suite>\"");
  EXPECT_EQ(suite.attribute("tests").as_int(), 9);
  EXPECT_EQ(suite.attribute("time").as_double(), 9 * 0.25);
  EXPECT_EQ(suite.child("testcase").attribute("time").as_double(), 0.25);
  EXPECT_EQ(suite.attribute("failures").as_int(), 4);  // fail, regressed, unstable, missing
  EXPECT_EQ(suite.attribute("errors").as_int(), 1);
  EXPECT_EQ(suite.attribute("skipped").as_int(), 2);  // skipped, no baseline
  EXPECT_EQ(document.select_nodes("//testcase").size(), 9u);
  EXPECT_EQ(document.select_nodes("//testcase/failure").size(), 4u);
  EXPECT_EQ(document.select_nodes("//testcase/error").size(), 1u);
  EXPECT_EQ(document.select_nodes("//testcase/skipped").size(), 2u);
  const pugi::xml_node failure = document.select_node("//testcase[@name='FAIL']/failure").node();
  for (const char* part : {"wave speed", "2290 m/s", "2050 m/s", "[1900, 2200] m/s", "static stiffness"}) {
    EXPECT_NE(std::string(failure.attribute("message").value()).find(part), std::string::npos) << part;
    EXPECT_NE(std::string(failure.text().get()).find(part), std::string::npos) << part;
  }
  EXPECT_NE(std::string(failure.text().get()).find("./ddem run \"a & b.toml\""), std::string::npos);
}

TEST(Junit, NoVerdictsAreAnEmptySuite) {
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(render_junit("s", {}).c_str()));
  EXPECT_EQ(document.child("testsuites").attribute("tests").as_int(-1), 0);
}

TEST(Verdict, AcceptedInWords) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(accepted_text({.lower = 1, .upper = 2, .unit = "m"}), "[1, 2] m");
  EXPECT_EQ(accepted_text({.upper = 1e-12}), "at most 1×10⁻¹²");
  EXPECT_EQ(accepted_text({.lower = 0.5, .upper = inf}), "at least 0.5");
  EXPECT_EQ(outcome_text({.metric = "nu", .upper = 1}), "nu: not measured (accepted at most 1): ERROR");
}

TEST(Verdict, WorstComeFirstAndTheCountIsRight) {
  const std::vector<Verdict> verdicts = one_of_each();
  const auto sorted = worst_first(verdicts);
  EXPECT_EQ(sorted.front()->state, State::error);
  EXPECT_EQ(sorted[1]->state, State::fail);
  EXPECT_EQ(sorted.back()->state, State::pass);
  EXPECT_EQ(headcount(verdicts),
            "2 of 9 passed, 1 ERROR, 1 FAIL, 1 UNSTABLE, 1 REGRESSED, 1 MISSING, 1 NO_BASELINE, 1 SKIPPED");
  EXPECT_EQ(headcount({{.state = State::pass}, {.state = State::unstable_as_expected}}), "2 of 2 passed");
}

}  // namespace
}  // namespace ddem::reports
