// The table of what keys mean beside others: its rows are about keys that there are, and each is what the reader does.

#include "harness/scene/key_rules.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "tests/harness/scene/scene_text.h"

namespace ddem::harness::test {
namespace {

using testing::HasSubstr;

const KeySpec& spec_of(std::string_view dotted) { return scene_keys()[find_key(dotted).value()]; }

/// A line for the key, right by itself.
std::string line_of(std::string_view dotted, std::string_view choice = {}) {
  const KeySpec& spec = spec_of(dotted);
  write_file("some.csv", "");
  std::string value = "3";
  if (spec.type == ValueType::choice) value = fmt::format("\"{}\"", choice.empty() ? split_names(spec.choices).back() : choice);
  if (spec.type == ValueType::file) value = "\"some.csv\"";
  if (spec.type == ValueType::boolean) value = "true";
  if (spec.type == ValueType::counts || spec.type == ValueType::indices) value = "[3, 4]";
  if (spec.type == ValueType::points) value = "[[1e-3, 1e-3]]";
  if (dotted == "deformation.poisson_ratio" || dotted == "deformation.relaxation" || dotted == "assembly.bond_gap") value = "0.3";
  if (dotted == "deformation.tolerance") value = "1e-3";
  return fmt::format("{}.{} = {}\n", spec.table, spec.key, value);
}

bool accuses(const SceneResult& result, std::string_view key, std::string_view message) {
  return std::any_of(result.violations.begin(), result.violations.end(),
                     [&](const Violation& v) { return v.key == key && v.message.find(message) != std::string::npos; });
}

TEST(KeyRules, AreAboutKeysAndValuesThatThereAre) {
  const auto expect_values = [](std::string_view key, std::string_view values) {
    const auto known = split_names(spec_of(key).choices);
    for (const std::string_view value : split_names(values)) EXPECT_THAT(known, testing::Contains(value)) << key;
  };
  for (const OnlyWith& rule : only_with_rules()) {
    expect_values(rule.selector, rule.choices);
    for (const std::string_view key : split_names(rule.keys)) EXPECT_TRUE(find_key(key)) << key;
  }
  for (const Exclusion& rule : exclusions()) {
    for (const KeysWith& side : {rule.first, rule.second}) {
      for (const std::string_view key : split_names(side.keys)) {
        ASSERT_TRUE(find_key(key)) << key;
        if (!side.values.empty()) expect_values(key, side.values);
      }
    }
  }
}

TEST(KeyRules, AKeyIsTakenOnlyWithTheChoicesThatItNeeds) {
  for (const OnlyWith& rule : only_with_rules()) {
    const auto needed = split_names(rule.choices);
    for (const std::string_view choice : split_names(spec_of(rule.selector).choices)) {
      for (const std::string_view key : split_names(rule.keys)) {
        const SceneResult result = parse(line_of(rule.selector, choice) + line_of(key));
        const bool fits = std::find(needed.begin(), needed.end(), choice) != needed.end();
        EXPECT_NE(accuses(result, key, "means nothing unless"), fits) << key << " with " << choice;
      }
    }
  }
}

TEST(KeyRules, OfTwoThatExcludeEachOtherTheSecondIsRefused) {
  for (const Exclusion& rule : exclusions()) {
    for (const std::string_view first : split_names(rule.first.keys)) {
      for (const std::string_view second : split_names(rule.second.keys)) {
        const auto values = [](const KeysWith& side) { return side.values.empty() ? std::vector<std::string_view>{{}} : split_names(side.values); };
        for (const std::string_view choice : values(rule.first)) {
          for (const std::string_view other : values(rule.second)) {
            const SceneResult result = parse(line_of(first, choice) + line_of(second, other));
            EXPECT_TRUE(accuses(result, second, rule.message.empty() ? "contradicts" : rule.message)) << first << ", " << second;
          }
        }
      }
    }
  }
}

TEST(KeyRules, WithoutDiscsTheirKeysMeanNothing) {
  const std::string continuum =
      "assembly.length = 1e-2\nassembly.width = 1e-3\nmaterial = {}\ncontinuum = {young_modulus = 1e10, poisson_ratio = 0.2, density = 2000}\n"
      "drive = {wave = \"shear\", duration = 1e-6, amplitude = 1e-6}\n";
  EXPECT_TRUE(parse(replaced(continuum, "material = {}\n", ""), Purpose::continuum));
  for (const char* key : {"assembly.seed", "assembly.radius", "assembly.bond_gap", "assembly.edge_band", "assembly.thickness", "contact.kinematics",
                          "deformation.scheme"}) {
    const SceneResult result = parse(replaced(continuum, "material = {}\n", line_of(key)), Purpose::continuum);
    EXPECT_TRUE(accuses(result, key, "means nothing unless assembly.packing")) << key << "\n" << to_string(result.violations);
  }
}

TEST(KeyRules, StandInTheReference) {
  EXPECT_EQ(describe_rules(spec_of("initial.width")),
            "only with initial.shape = \"cosine\" or \"gaussian\"; not beside initial.displacement, initial.velocity");
  EXPECT_EQ(describe_rules(spec_of("boundary.right")), "\"fixed_x\" or \"fixed\" not beside assembly.periodic = \"xy\"");
  EXPECT_EQ(describe_rules(spec_of("title")), "");
}

TEST(KeyRules, NothingIsSaidTwice) {
  const SceneResult result = parse(small_scene() + "displacement = \"some.csv\"\nwidth = 1e-3\ncenter = 1e-3\n");
  EXPECT_EQ(std::count_if(result.violations.begin(), result.violations.end(), [](const Violation& v) { return v.key == "initial.width"; }), 1);
}

}  // namespace
}  // namespace ddem::harness::test
