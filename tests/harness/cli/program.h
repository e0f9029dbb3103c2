#pragma once
// Runs the built ddem in a folder of its own and looks at what it leaves there.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "harness/io/subprocess.h"
#include "harness/io/temporary_folder.h"

namespace ddem::harness::test {

/// A scene that runs in milliseconds: 240 discs, hexagonal, periodic in y, three pairs of probes.
std::string small_scene();

/// The discs of small_scene() as a file: radius 0.1 mm, 30 columns along x, 8 rows, disc = 30 row + column.
struct Disc {
  double x, y, radius;
};
std::vector<Disc> small_lattice();
std::string disc_table(const std::vector<Disc>& discs);
/// small_scene() with its discs from discs.csv.
std::string file_scene();

/// `text` with the only `old` in it replaced; a test that replaces nothing fails.
std::string replaced(std::string text, std::string_view old, std::string_view by);
/// small_scene() with lines before [probes].
std::string with_table(const std::string& scene, std::string_view lines);

/// Text that no parser expects: the same bytes on every run.
std::string rubbish(std::size_t bytes);

class Cli : public testing::Test {
 protected:
  std::filesystem::path in_folder(const std::string& name) const { return folder_.path() / name; }
  std::string path(const std::string& name) const { return in_folder(name).string(); }
  void write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;

  SubprocessResult ddem(const std::vector<std::string>& arguments) const;

  /// Names (folders included) and contents of everything in the folder.
  std::map<std::string, std::string> contents() const;
  void expect_contents(const std::map<std::string, std::string>& expected) const;

  /// `ddem run` of scene.toml, asked to write a file that is there and one that is not, ends with the exit
  /// code, says every part, prints nothing and leaves the folder as it was.
  void expect_refused(const std::vector<std::string>& parts, int exit_code = 2) const;

 private:
  TemporaryFolder folder_{"ddem-cli-test"};
};

}  // namespace ddem::harness::test
