// The page in the guide is what the table of keys says now.

#include "harness/scene/reference.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "harness/scene/keys.h"

namespace ddem::harness {
namespace {

TEST(SceneReference, ThePageOfTheGuideIsUpToDate) {
  std::ifstream page(DDEM_GUIDE "/scene.md");
  const std::string text{std::istreambuf_iterator<char>(page), {}};
  EXPECT_TRUE(text == scene_reference())
      << "keys have changed: ddem scene-reference > harness/guide/scene.md";
}

TEST(SceneReference, HasEveryKeyInItsSection) {
  const std::string text = scene_reference();
  for (const KeySpec& k : scene_keys()) {
    const std::size_t section = k.table.empty() ? 0 : text.find(fmt::format("\n## [{}]\n", k.table));
    ASSERT_NE(section, std::string::npos) << k.table;
    const std::size_t end = text.find("\n## [", section + 1);
    const std::size_t row = text.find(fmt::format("\n| `{}` |", k.key), section);
    EXPECT_LT(row, end) << dotted_name(k.table, k.key);
  }
}

}  // namespace
}  // namespace ddem::harness
