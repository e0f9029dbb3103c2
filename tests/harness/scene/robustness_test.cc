// Files that are no scenes: never a crash, a hang or an exception.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <random>
#include <thread>

#include "harness/scene/csv.h"
#include "harness/scene/nearest_name.h"
#include "tests/harness/scene/scene_text.h"

namespace ddem::harness::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string repeated(std::string_view unit, int times) {
  std::string text;
  for (int k = 0; k < times; ++k) text += unit;
  return text;
}

TEST(Robustness, SyntaxErrorsHaveFileLineAndColumn) {
  const SceneResult result = parse("[assembly]\nlength = = 3\n");
  ASSERT_EQ(result.violations.size(), 1u);
  EXPECT_EQ(result.violations[0].line, 2);
  EXPECT_EQ(result.violations[0].column, 10);
  EXPECT_THAT(to_string(result.violations[0]), StartsWith("scene.toml:2:10: "));
  EXPECT_THAT(messages("[assembly]\nseed = 1\nseed = 2\n"), StartsWith("scene.toml:3:"));
}

TEST(Robustness, DeepNestingIsRefused) {
  const int deep = 100'000;
  for (const std::string& text :
       {repeated("[", deep), "a = " + repeated("[", deep), "a = " + repeated("{a=", deep),
        repeated("[[", deep), "[" + repeated("a.", deep) + "a]\n", repeated("a.", deep) + "a = 1\n",
        "[" + repeated("'a'.", deep) + "a]", "a = {" + repeated("\"\\\"\" . ", deep) + "a = 1}"}) {
    EXPECT_EQ(parse(text).violations.size(), 1u) << text.substr(0, 20);
  }
  // As deep as the limits allow: 254 inline tables, each under a key of nine parts.
  const std::string legal = repeated("{a.b.c.d.e.f.g.h.i = ", 254) + "1" + repeated("}", 254);
  EXPECT_THAT(messages("[run]\nthreads = " + legal + "\n"), HasSubstr("wrong type: this is a table"));
  EXPECT_THAT(messages("title = '''\n\n'''\n[a.b.c.d.e.f.g.h.i.j]\n"),
              HasSubstr("scene.toml:4:19: a key with too many"));
}

TEST(Robustness, DotsInTextAndNumbersAreNotNesting) {
  const std::string dots = repeated(".", 50);
  EXPECT_TRUE(parse("title = \"" + dots + "\" # " + dots + "\n" + small_scene()));
  EXPECT_TRUE(parse("title = '''" + dots + "\n'" + dots + "''' # '\n" + small_scene()));
  std::string points = "[probes]\npoints = [";
  for (int k = 0; k < 30; ++k) points += "[0.001, 0.001],";
  EXPECT_TRUE(parse(small_scene() + points + "]\n"));
}

TEST(Robustness, RubbishIsRefusedInPrintableText) {
  std::mt19937 random(7);
  for (int k = 0; k < 200; ++k) {
    std::string text(200, ' ');
    for (char& c : text) c = static_cast<char>(random());
    const SceneResult result = parse(text);
    EXPECT_FALSE(result.violations.empty());
    for (const char c : to_string(result.violations.front()))
      EXPECT_TRUE(static_cast<unsigned char>(c) >= 0x20);
  }
  EXPECT_FALSE(parse(std::string(1000, '\0')));
  EXPECT_FALSE(parse(""));
  EXPECT_FALSE(parse("\xFF\xFE[\0a\0]\0"));
}

TEST(Robustness, ListsOfMistakesEnd) {
  std::string text;
  for (int k = 0; k < 20'000; ++k) text += fmt::format("k{} = 1\n", k);
  const SceneResult lines = parse(text);
  EXPECT_FALSE(lines.violations.empty());
  EXPECT_LE(lines.violations.size(), 1001u);
  EXPECT_THAT(to_string(lines.violations.back()), HasSubstr("the rest was not looked at"));

  text = "assembly = {";
  for (int k = 0; k < 20'000; ++k) text += fmt::format("k{} = 1, ", k);
  EXPECT_LE(parse(text + "z = 1}").violations.size(), 1001u);
}

TEST(Robustness, FilesThatAreNoScenes) {
  const auto read = [](const std::filesystem::path& path) { return to_string(read_scene(path).violations); };
  EXPECT_THAT(read(temporary_folder() / "none.toml"), HasSubstr("none.toml: cannot be read: No such file"));
  EXPECT_THAT(read(temporary_folder()), HasSubstr("this is a folder"));
  EXPECT_THAT(read("/dev/zero"), HasSubstr("/dev/zero: this is a device, not a file"));
  EXPECT_THAT(read(write_file("large.toml", std::string((4 << 20) + 1, '#'))), HasSubstr("larger than 4 MiB"));
  EXPECT_THAT(read(write_file("empty.toml", "")), HasSubstr("assembly.packing: missing"));
}

// A scene may come through a pipe. What a scene names is a file: it is looked at more than once.
TEST(Robustness, PipesAreScenesButNoData) {
  const std::filesystem::path pipe = temporary_folder() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  // For reading, too, so that opening it waits for nobody: what is small enough stays in the pipe.
  const int end = ::open(pipe.c_str(), O_RDWR);
  const std::string text = small_scene();
  ASSERT_EQ(::write(end, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  std::thread writer([end] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    ::close(end);
  });
  const SceneResult scene = read_scene(pipe);
  writer.join();
  EXPECT_TRUE(scene) << to_string(scene.violations);
  EXPECT_THAT(to_string(read_disc_table(pipe).violations), HasSubstr("pipe: this is a pipe, not a file"));
  for (const char* device : {"/dev/zero", "/dev/null"})
    EXPECT_THAT(to_string(read_state_table(device).violations), HasSubstr("this is a device"));
}

// Truncations and mutations of a scene that has everything: each parses or is refused, and nothing else.
TEST(Robustness, SurvivesTruncationAndMutation) {
  const std::string scene = full_scene();
  for (std::size_t length = 0; length < scene.size(); ++length) {
    const SceneResult result = parse(std::string_view(scene).substr(0, length));
    EXPECT_NE(result.value.has_value(), !result.violations.empty());
  }
  std::mt19937 random(11);
  const std::string_view favourites = "[]{}\"'=.,#\n\\-+eE0\xFF";
  for (int k = 0; k < 3000; ++k) {
    std::string text = scene;
    for (unsigned changes = 1 + random() % 4; changes > 0; --changes) {
      char& c = text[random() % text.size()];
      c = random() % 2 == 0 ? favourites[random() % favourites.size()] : static_cast<char>(random());
    }
    const SceneResult result = parse(text);
    EXPECT_NE(result.value.has_value(), !result.violations.empty());
  }
}

TEST(Robustness, EditDistanceCountsSlips) {
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("stifness", "stiffness"), 1);
  EXPECT_EQ(edit_distance("lenght", "length"), 1);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
  const std::string_view names[] = {"length", "width"};
  EXPECT_EQ(nearest_name("widht", names), "width");
  EXPECT_EQ(nearest_name("radius", names), std::nullopt);
  EXPECT_EQ(nearest_name(std::string(100'000, 'a'), names), std::nullopt);
}

TEST(Robustness, PrintableTextIsOneLineOfUtf8) {
  EXPECT_EQ(printable("a\nb\x7F\xC3\xA9\xC3(\x80", 100), "a\\x0ab\\x7f\xC3\xA9\\xc3(\\x80");
  EXPECT_EQ(printable("abcdef", 3), "abc...");
}

}  // namespace
}  // namespace ddem::harness::test
