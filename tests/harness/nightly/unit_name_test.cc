// Names of units as files: whatever they are called, each has one of its own, inside its folder.

#include "harness/nightly/unit_name.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "tests/harness/nightly/toy_units.h"

namespace ddem::harness::nightly {
namespace {

std::vector<std::string> parts_of(const std::filesystem::path& path) {
  return {path.begin(), path.end()};
}

/// Names that are close to each other and to what escapes look like: half of them out of a few pieces, the others bytes.
std::string random_name(std::mt19937& random) {
  static const std::vector<std::string> pieces = {"a", "b", ".unit", ".", "..", "/", "%", "%2E", "%2F", "%", "~", "A", "\xc3\xa9", "-", "x=1e+5"};
  std::uniform_int_distribution<int> length(1, 7), byte(1, 255);
  std::uniform_int_distribution<std::size_t> piece(0, pieces.size() - 1);
  std::string name;
  const bool bytes = byte(random) < 64;
  for (int k = length(random); k > 0; --k) name += bytes ? std::string(1, static_cast<char>(byte(random))) : pieces[piece(random)];
  return name;
}

/// Neither file nor folder is shared between a file and a folder, nor a file between two names.
void expect_apart(const std::vector<std::string>& names) {
  std::map<std::string, std::string> files;
  std::set<std::string> folders;
  for (const std::string& name : names) {
    const std::filesystem::path file = file_of_unit(name);
    const auto [place, is_new] = files.emplace(file.string(), name);
    EXPECT_TRUE(is_new || place->second == name) << file << ": " << name << " and " << place->second;
    for (auto up = file.parent_path(); !up.empty(); up = up.parent_path()) folders.insert(up.string());
    EXPECT_LT(file.string().size(), 1100u);
    for (const std::string& part : parts_of(file)) {
      EXPECT_LE(part.size(), 205u) << name;
      EXPECT_NE(part.front(), '.') << name;
      for (const char c : part) EXPECT_TRUE(c > ' ' && c < 127) << name;
    }
  }
  for (const auto& [file, name] : files) EXPECT_FALSE(folders.contains(file)) << name << " is a folder of another name";
}

TEST(UnitName, PlainNamesStayAsTheyAre) {
  EXPECT_EQ(file_of_unit("material/random-1/lagged-full/kt0.30"), "material/random-1/lagged-full/kt0.30.unit");
  EXPECT_EQ(file_of_unit("case/small/stiffness_ratio=0.1/density=2000-kg-m3"), "case/small/stiffness_ratio=0.1/density=2000-kg-m3.unit");
}

TEST(UnitName, NamesThatEndAsFilesDo) {
  expect_apart({"case/a", "case/a.unit", "case/a.unit/k=0", "case/a.unit.unit", "case/a.unit/k=0.unit", "case/a%2Eunit", "case/a/.unit", "case/.unit"});
}

TEST(UnitName, NothingLeadsOutOfTheFolder) {
  expect_apart({"..", "../x", "/etc/passwd", "a/../../x", ".", "", "/", "//", "a//b", "a/b", "a/b/", ".hidden", "case/~", "%~", "%"});
}

TEST(UnitName, LongNames) {
  std::vector<std::string> names;
  for (const std::size_t length : {199u, 200u, 201u, 254u, 255u, 256u, 5000u}) {
    names.push_back(std::string(length, 'a'));
    names.push_back(std::string(length, 'a') + "/b");
    names.push_back(std::string(length - 1, 'a') + "b");
    names.push_back(std::string(length, '\xe9'));
  }
  std::string deep;
  for (int k = 0; k < 900; ++k) names.push_back(deep += "a/");
  expect_apart(names);
}

TEST(UnitName, AnyTwoNamesAreApart) {
  std::mt19937 random(11);
  std::vector<std::string> names;
  for (int k = 0; k < 50000; ++k) names.push_back(random_name(random));
  expect_apart(names);
}

/// On the disk: all are written, and each is read back as itself.
TEST(UnitName, UnitsOfLikeNamesDoNotMeet) {
  const Scratch scratch;
  std::mt19937 random(12);
  std::map<std::string, double> seconds = {{"case/a", 1.0}, {"case/a.unit", 2.0}, {"case/a.unit/stiffness_ratio=0", 3.0}};
  for (int k = 0; k < 300; ++k) seconds[random_name(random)] = 10.0 + k;
  for (const auto& [id, s] : seconds) write_unit(scratch / "", {id, "identity", {toy_result(1), "", s}});
  for (const auto& [id, s] : seconds) EXPECT_EQ(read_unit(scratch / "", id, "identity").outcome.seconds, s) << id;
}

}  // namespace
}  // namespace ddem::harness::nightly
