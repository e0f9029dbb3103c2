// The case file: what is wrong is named by case and key, all of it at once.

#include <gtest/gtest.h>

#include <string>

#include "fem_reference/cases.h"
#include "tests/fem_reference/case_builder.h"

namespace ddem::fem {
namespace {

using test::bar_case;
using test::case_file;
using test::Json;
using test::shear_case;

std::string complaint(const std::string& text) {
  try {
    parse_cases(text);
  } catch (const CaseError& error) {
    return error.what();
  }
  return "";
}

TEST(CaseFile, ReadsWhatItSays) {
  Json driven = bar_case("two");
  driven["initial"] = nullptr;
  driven["drive"] = {{"wave", "shear"}, {"shape", "sin2"}, {"duration", 3e-6}, {"amplitude", -2e-6}};
  driven["time"] = {{"step_fraction", 0.5}, {"steps", 100}};
  driven["right"] = "fixed";
  driven["plane"] = "strain";
  const auto cases = parse_cases(case_file({shear_case("one"), driven}));
  ASSERT_EQ(cases.size(), 2u);
  EXPECT_EQ(cases[0].id, "one");
  EXPECT_TRUE(cases[0].periodic);
  EXPECT_EQ(cases[0].initial->shape, Shape::gaussian);
  EXPECT_EQ(cases[0].initial->center, 3e-3);
  EXPECT_EQ(cases[0].elements[1], 8u);
  EXPECT_EQ(cases[0].receivers.points[9][0], 0.001 + 0.0013 * 9);
  EXPECT_EQ(cases[0].time.end, 7.5e-6);
  EXPECT_EQ(cases[0].sample_every, 4u);
  EXPECT_FALSE(cases[1].initial);
  EXPECT_EQ(cases[1].drive->amplitude, -2e-6);
  EXPECT_EQ(cases[1].right, End::fixed);
  EXPECT_EQ(cases[1].plane, Plane::strain);
  EXPECT_EQ(cases[1].time.steps, 100u);
}

struct Bad {
  const char* path;   // JSON pointer into the case
  const char* value;  // JSON; "" removes the key
  const char* named;  // the message names it
};

class BadKey : public testing::TestWithParam<Bad> {};

TEST_P(BadKey, IsNamedWithItsCase) {
  Json broken = shear_case("broken");
  const Json::json_pointer path(GetParam().path);
  if (std::string(GetParam().value).empty()) {
    broken.at(path.parent_pointer()).erase(path.back());
  } else {
    broken[path] = Json::parse(GetParam().value);
  }
  const std::string what = complaint(case_file({shear_case("good"), broken}));
  EXPECT_NE(what.find("case \"broken\""), std::string::npos) << what;
  EXPECT_NE(what.find(GetParam().named), std::string::npos) << what;
  EXPECT_EQ(what.find("good"), std::string::npos) << what;
}

INSTANTIATE_TEST_SUITE_P(
    Keys, BadKey,
    testing::Values(
        Bad{"/length", "-1", "length"}, Bad{"/length", "\"16.5 mm\"", "length"}, Bad{"/width", "0", "width"},
        Bad{"/width", "", "width"}, Bad{"/elements", "[66]", "elements"},
        Bad{"/elements", "[66, 0]", "elements"}, Bad{"/elements", "[66, 8.5]", "elements"},
        Bad{"/elements", "[1000000, 1000000]", "elements"}, Bad{"/degree", "9", "degree"},
        Bad{"/degree", "true", "degree"}, Bad{"/young_modulus", "-1e10", "young_modulus"},
        Bad{"/poisson_ratio", "1.0", "poisson_ratio"}, Bad{"/poisson_ratio", "", "poisson_ratio"},
        Bad{"/density", "null", "density"}, Bad{"/plane", "\"flat\"", "plane"},
        Bad{"/top_bottom", "3", "top_bottom"}, Bad{"/right", "\"left\"", "right"},
        Bad{"/left", "\"right\"", "left"}, Bad{"/colour", "1", "colour"}, Bad{"/initial", "null", "initial"},
        Bad{"/initial", "[]", "initial"}, Bad{"/initial/wave", "\"love\"", "wave"},
        Bad{"/initial/width", "", "width"}, Bad{"/initial/shape", "\"column\"", "spacing"},
        Bad{"/initial/amplitude", "0", "amplitude"}, Bad{"/initial/colour", "1", "colour"},
        Bad{"/drive", "{}", "duration"}, Bad{"/time/step_fraction", "0", "step_fraction"},
        Bad{"/time/step_fraction", "2.5", "step_fraction"}, Bad{"/time/end", "", "time"},
        Bad{"/time/end", "-1", "end"}, Bad{"/time/steps", "10", "time"}, Bad{"/time", "", "time"},
        Bad{"/receivers/points", "[[0.02, 0]]", "points"}, Bad{"/receivers/points", "[[0.01]]", "points"},
        Bad{"/receivers/points", "0.01", "points"}, Bad{"/receivers/sections", "[-0.001]", "sections"},
        Bad{"/receivers", "", "receivers"}, Bad{"/sample_every", "0", "sample_every"},
        Bad{"/snapshots", "0", "snapshots"}, Bad{"/snapshots", "2.5", "snapshots"},
        Bad{"/snapshots", "10001", "snapshots"}));

TEST(CaseFile, TakesSnapshotsOfTheLeapfrogAlone) {
  Json snapshots = shear_case("snapshots");
  EXPECT_EQ(parse_cases(case_file({snapshots})).front().snapshots, 0u);
  snapshots["snapshots"] = 12;
  EXPECT_EQ(parse_cases(case_file({snapshots})).front().snapshots, 12u);
  snapshots["time"]["integrator"] = "exact";
  const std::string what = complaint(case_file({snapshots}));
  EXPECT_NE(what.find("case \"snapshots\": snapshots need the integrator \"verlet\""), std::string::npos) << what;
}

TEST(CaseFile, ListsAllProblemsAtOnce) {
  Json broken = shear_case("broken");
  broken["length"] = -1.0;
  broken["density"] = "heavy";
  broken["time"].erase("step_fraction");
  const std::string what = complaint(case_file({broken, broken}));
  for (const char* named : {"length", "density", "step_fraction", "earlier case"}) {
    EXPECT_NE(what.find(named), std::string::npos) << named << " in\n" << what;
  }
}

TEST(CaseFile, RefusesWhatIsNoCaseFile) {
  for (const std::string& text :
       {std::string(), std::string("[]"), std::string("{}"), std::string("{\"schema\": 2, \"cases\": []}"),
        std::string("{\"schema\": 1, \"cases\": {}}"), std::string("{\"schema\": 1, \"cases\": [1, null]}"),
        std::string(100'000, '['), std::string("\0\xff\xfe", 3),
        std::string("{\"schema\": 1, \"cases\": [1e999]}"),
        std::string(100'000, '[') + std::string(100'000, ']')}) {
    EXPECT_NE(complaint(text), "") << text.substr(0, 40);
  }
  EXPECT_EQ(complaint(""), "line 1: no JSON");
  EXPECT_EQ(complaint("{\n\"schema\": 1,\n\"cases\": [,]}"), "line 3: no JSON");
  EXPECT_NE(complaint("{\"schema\": " + std::string(200'000, '[') + std::string(200'000, ']') + "}").find("nested too deeply"), std::string::npos);
  EXPECT_EQ(complaint("{\"schema\": 1e999}"), "holds a number that is too large");
  EXPECT_THROW(read_cases("/no/such/file"), CaseError);
  EXPECT_THROW(read_cases("/"), CaseError);
}

TEST(CaseFile, RefusesIdsThatNameNoGroup) {
  for (const char* id : {"", "a/b", "."}) {
    EXPECT_NE(complaint(case_file({shear_case(id)})).find("id"), std::string::npos);
  }
}

}  // namespace
}  // namespace ddem::fem
