// The manifest: what was planned is what is run, or it is refused.

#include "harness/nightly/plan.h"

#include <gtest/gtest.h>

#include "harness/io/errors.h"
#include "tests/harness/nightly/toy_units.h"

namespace ddem::harness::nightly {
namespace {

TEST(Plan, RoundTripAndReadOnly) {
  const Scratch scratch;
  EXPECT_FALSE(has_plan(scratch / ""));
  EXPECT_THROW(read_plan(scratch / ""), InputError);
  const Plan plan = toy_plan(toy_units(7));
  write_plan(scratch / "", plan);
  EXPECT_EQ(difference(read_plan(scratch / ""), plan), "");
  EXPECT_EQ(
      std::filesystem::status(scratch / "plan.json").permissions() & std::filesystem::perms::owner_write,
      std::filesystem::perms::none);
  write_plan(scratch / "", plan);  // a campaign that is run anew
}

TEST(Plan, ChangedByHandIsRefused) {
  const Scratch scratch;
  write_plan(scratch / "", toy_plan(toy_units(3)));
  const std::string text = content_of(scratch / "plan.json");
  const auto read_as = [&](const std::string& changed) {
    std::filesystem::remove(scratch / "plan.json");
    put(scratch / "plan.json", changed);
    read_plan(scratch / "");
  };
  std::string renamed = text;
  renamed.replace(renamed.find("unit-1"), 6, "unit-9");
  EXPECT_THROW(read_as(renamed), InputError);
  for (const char* rubbish : {"", "{}", "[1, 2]", "{\"program\": 3}", "null",
                              "{\"program\": \"p\", \"campaign\": {}, \"units\": 3, \"digest\": \"\"}"}) {
    EXPECT_THROW(read_as(rubbish), InputError) << rubbish;
  }
  EXPECT_NO_THROW(read_as(text));
}

TEST(Plan, DifferencesAreNamed) {
  const Plan plan = toy_plan(toy_units(5));
  EXPECT_NE(difference(plan, toy_plan(toy_units(4))).find("unit-4"), std::string::npos);
  Plan other = plan;
  other.program = "toy program 2";
  EXPECT_NE(difference(plan, other).find("toy program 2"), std::string::npos);
  other = plan;
  other.units[2].identity = "0";
  EXPECT_NE(difference(plan, other).find("unit-2"), std::string::npos);
  other = plan;
  other.campaign["title"] = "another";
  EXPECT_NE(difference(plan, other), "");
}

TEST(Plan, TwoUnitsOfOneNameAreOurError) {
  std::vector<Unit> units = toy_units(2);
  units[1].id = units[0].id;
  EXPECT_THROW(toy_plan(units), std::logic_error);
}

/// Where a campaign's file stood is kept, and makes no other plan of it: shards may be started from anywhere.
TEST(Plan, ItsSourceIsNoPartOfIt) {
  const Scratch scratch;
  Plan here = toy_plan(toy_units(3)), there = here;
  here.source = "a/campaign.toml";
  EXPECT_EQ(difference(here, there), "");
  write_plan(scratch / "", here);
  EXPECT_EQ(read_plan(scratch / "").source, here.source);
  EXPECT_TRUE(holds_plan(scratch / "", there));
  std::string text = content_of(scratch / "plan.json");
  text.replace(text.find("a/campaign"), 1, "b");
  std::filesystem::remove(scratch / "plan.json");
  put(scratch / "plan.json", text);
  EXPECT_NE(message_of<InputError>([&] { read_plan(scratch / ""); }).find("digest"), std::string::npos);
  EXPECT_FALSE(holds_plan(scratch / "", there));
}

}  // namespace
}  // namespace ddem::harness::nightly
