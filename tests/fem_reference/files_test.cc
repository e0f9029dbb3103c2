// What ddem-fem does to files and streams that are not as they should be.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdio>
#include <filesystem>

#include "tests/fem_reference/case_builder.h"
#include "tests/fem_reference/program.h"
#include "tests/support/strip_meshes.h"

namespace ddem::fem {
namespace {

using test::case_file;
using test::Json;
using test::shear_case;
using test::SignalsReader;
using test::Workplace;
namespace fs = std::filesystem;

Json small(const std::string& id) {
  Json strip = shear_case(id);
  strip["elements"] = {4, 1};
  strip["degree"] = 2;
  return strip;
}

Json on_mesh(const std::string& id, const std::string& file, double factor = 1.0) {
  Json strip = small(id);
  strip["length"] = factor * ddem::test::test_strip.length;
  strip["width"] = factor * ddem::test::test_strip.width;
  strip["receivers"] = {{"sections", {0.005}}};
  strip.erase("elements");
  strip["mesh"] = file;
  return strip;
}

TEST(ProgramFiles, NoOutputOverwritesAnInputOrAForeignFile) {
  const Workplace place;
  const std::string cases = case_file({on_mesh("a", "strip.msh")}), mesh = ddem::test::msh_text(ddem::test::strip_mesh(4, 2));
  place.write("cases.json", cases);
  place.write("strip.msh", mesh);
  place.write("notes.txt", "mine");
  fs::create_symlink("cases.json", place / "link");
  fs::create_hard_link(place / "strip.msh", place / "second_name");
  for (const char* output : {"link", "./strip.msh", "second_name", "notes.txt"}) {
    const auto outcome = place.run(std::string("cases.json -o ") + output);
    EXPECT_EQ(outcome.exit_code, 2) << output;
    EXPECT_NE(outcome.errors.find(output), std::string::npos) << outcome.errors;
    EXPECT_NE(outcome.errors.find("name another file"), std::string::npos) << outcome.errors;
  }
  EXPECT_EQ(place.read("cases.json"), cases);
  EXPECT_EQ(place.read("strip.msh"), mesh);
  EXPECT_EQ(place.read("notes.txt"), "mine");
  EXPECT_TRUE(fs::is_symlink(place / "link"));
  EXPECT_EQ(place.file_count(), 5u);
}

TEST(ProgramFiles, ReplacesEarlierSignalsAndNothingElseOfThem) {
  const Workplace place;
  place.write("cases.json", case_file({small("a")}));
  place.write("signals.h5", "");
  fs::permissions(place / "signals.h5", fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("signals.h5", place / "link");
  for (int k = 0; k < 2; ++k) {
    const auto outcome = place.run("cases.json -o link");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
    EXPECT_TRUE(fs::is_symlink(place / "link"));
    EXPECT_EQ(fs::status(place / "signals.h5").permissions(), fs::perms::owner_read | fs::perms::owner_write);
    EXPECT_EQ(SignalsReader(place / "signals.h5").text("a", "status"), "ok");
  }
  ASSERT_EQ(mkfifo((place / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(place.run("cases.json -o pipe").exit_code, 4);
  EXPECT_TRUE(fs::is_fifo(place / "pipe"));
  EXPECT_EQ(place.file_count(), 4u);
}

TEST(ProgramFiles, StreamsThatAreClosedOrFullChangeNothing) {
  const Workplace place;
  place.write("cases.json", case_file({small("a")}));
  place.write("wrong.json", "{}");
  for (const char* streams : {"exec <&- >&- 2>&-; ", "exec 2>/dev/full; "}) {
    const auto with = [&](const std::string& arguments) {
      const std::string command = fmt::format("cd '{}' && ({} '{}' {})", (place / "").string(), streams, DDEM_FEM_PROGRAM, arguments);
      const int status = std::system(command.c_str());
      return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    };
    EXPECT_EQ(with("cases.json -o signals.h5 --progress"), 0) << streams;
    EXPECT_EQ(SignalsReader(place / "signals.h5").text("a", "status"), "ok") << streams;
    EXPECT_EQ(with("wrong.json -o signals.h5"), 2) << streams;
  }
}

TEST(ProgramFiles, LimitsOfFileSizesAreErrors) {
  const Workplace place;
  Json strip = small("a");
  strip["sample_every"] = 1;
  place.write("cases.json", case_file({strip}));
  for (const int limit : {1, 2, 20}) {  // in units of 512 bytes: the signals do not fit; a mesh of its own is no file
    const auto outcome = place.run("cases.json -o signals.h5", fmt::format("ulimit -f {}; ", limit));
    EXPECT_EQ(outcome.exit_code, 4) << limit << outcome.errors;
    EXPECT_NE(outcome.errors.find(fmt::format(": File too large (this process may write files of {} bytes: ulimit -f)", 512 * limit)), std::string::npos)
        << limit << outcome.errors;
    EXPECT_NE(outcome.errors.find("cannot write signals.h5"), std::string::npos) << limit << outcome.errors;
    EXPECT_EQ(place.file_count(), 1u) << limit;
  }
}

/// Said before anything is solved, and through a pipe: a file would not take the message either.
TEST(ProgramFiles, ALimitOfNothingIsAnErrorAtOnce) {
  const Workplace place;
  Json endless = small("endless");
  endless["time"] = {{"step_fraction", 1e-4}, {"end", 1e-2}};
  endless["sample_every"] = 100'000'000;
  place.write("cases.json", case_file({endless}));
  const std::string command = fmt::format("cd '{}' && ulimit -f 0 && timeout 20 '{}' cases.json -o signals.h5 2>&1; echo code $?", (place / "").string(), DDEM_FEM_PROGRAM);
  std::FILE* const pipe = ::popen(command.c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  std::string said(4096, '\0');
  said.resize(std::fread(said.data(), 1, said.size(), pipe));
  ::pclose(pipe);
  EXPECT_EQ(said, "ddem-fem: cannot write signals.h5: File too large (this process may write files of 0 bytes: ulimit -f)\ncode 4\n");
  EXPECT_EQ(place.file_count(), 1u);
}

TEST(ProgramFiles, AnInterruptedRunLeavesNothing) {
  const Workplace place;
  Json endless = small("endless");
  endless["time"] = {{"step_fraction", 1e-4}, {"end", 1e-2}};
  endless["sample_every"] = 100'000'000;
  place.write("cases.json", case_file({endless}));
  const auto outcome = place.run("cases.json -o signals.h5", "timeout -s TERM 2 ");
  EXPECT_EQ(outcome.exit_code, 124) << outcome.errors;
  EXPECT_EQ(place.file_count(), 1u);
}

TEST(ProgramFiles, AllMeshesAreReadBeforeAnythingIsSolved) {
  const Workplace place;
  auto wrong = ddem::test::strip_mesh(4, 2);
  wrong.quads.push_back(wrong.quads.front());
  place.write("right.msh", ddem::test::msh_text(ddem::test::strip_mesh(4, 2)));
  place.write("wrong.msh", ddem::test::msh_text(wrong));
  place.write("cases.json", case_file({small("first"), on_mesh("a", "right.msh"), on_mesh("b", "wrong.msh"), on_mesh("c", "right.msh", 2.0),
                                       on_mesh("d", "wrong.msh"), on_mesh("e", "none.msh")}));
  const auto outcome = place.run("cases.json -o signals.h5 --progress");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.errors.find("done"), std::string::npos) << outcome.errors;
  EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 3) << outcome.errors;
  for (const char* reason : {"right.msh: is 0.01 m long", "wrong.msh: elements 13 and 21 are one", "none.msh: is no file"}) {
    EXPECT_NE(outcome.errors.find(reason), std::string::npos) << outcome.errors;
  }
}

}  // namespace
}  // namespace ddem::fem
