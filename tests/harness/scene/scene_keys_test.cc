// The key table against itself and against the reader.

#include "harness/scene/keys.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/harness/scene/scene_text.h"

namespace ddem::harness::test {
namespace {

TEST(SceneKeys, EveryRowIsCompleteAndUnique) {
  std::set<std::string> seen;
  std::set<std::string_view> tables{""};
  for (const TableSpec& table : scene_tables()) {
    EXPECT_FALSE(table.doc.empty()) << table.name;
    tables.insert(table.name);
  }
  for (const KeySpec& spec : scene_keys()) {
    const std::string dotted = dotted_name(spec.table, spec.key);
    EXPECT_TRUE(seen.insert(dotted).second) << dotted;
    EXPECT_TRUE(tables.contains(spec.table)) << dotted;
    EXPECT_FALSE(spec.doc.empty()) << dotted;
    EXPECT_EQ(spec.doc.find('\n'), std::string_view::npos) << dotted;
    EXPECT_EQ(spec.type == ValueType::choice, !spec.choices.empty()) << dotted;
    EXPECT_FALSE(describe_value(spec).empty()) << dotted;
  }
}

// A value of a type that no key takes, given to each key in turn: each is recognised and blamed.
TEST(SceneKeys, EveryRowIsReadAndChecked) {
  for (const KeySpec& spec : scene_keys()) {
    if (spec.table.empty()) continue;
    const std::string text = fmt::format("[{}]\n{} = 1979-05-27T07:32:00Z\n", spec.table, spec.key);
    const SceneResult result = parse(text);
    const std::string dotted = dotted_name(spec.table, spec.key);
    int blamed = 0;
    for (const Violation& violation : result.violations) {
      if (violation.key != dotted || violation.message != "wrong type: this is a date or time") continue;
      ++blamed;
      EXPECT_EQ(violation.line, 2);
    }
    EXPECT_EQ(blamed, 1) << dotted;
  }
}

TEST(SceneKeys, RangesKeepTheirEnds) {
  const Range open{.low = -1.0, .high = 1.0, .low_excluded = true, .high_excluded = true};
  EXPECT_FALSE(open.contains(-1.0));
  EXPECT_FALSE(open.contains(1.0));
  EXPECT_TRUE(open.contains(0.0));
  const Range closed{.low = 1.0, .high = 10.0};
  EXPECT_TRUE(closed.contains(1.0));
  EXPECT_TRUE(closed.contains(10.0));
  EXPECT_FALSE(closed.contains(10.5));
  EXPECT_FALSE(Range{.zero_excluded = true}.contains(0.0));
}

TEST(SceneKeys, ChoicesAreSplit) {
  EXPECT_EQ(split_names("a | bc | d"), (std::vector<std::string_view>{"a", "bc", "d"}));
  EXPECT_EQ(split_names(" | y"), (std::vector<std::string_view>{"", "y"}));
}

}  // namespace
}  // namespace ddem::harness::test
