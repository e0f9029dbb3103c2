// Bytes changed, cut off and exchanged at random in every file that the program reads again: it is refused by its name, or made
// anew, or what was changed says nothing. Never a signal, never another number.

#include <sys/stat.h>

#include <map>

#include "harness/io/atomic_file.h"
#include "harness/io/errors.h"
#include "tests/harness/damage/kept_files.h"
#include "tests/harness/damage/mutations.h"

namespace ddem::harness::test {
namespace {

namespace fs = std::filesystem;

constexpr int kDamages = 2000;

/// Rewritten in place, as a disk would; write-protected files too.
void overwrite(const fs::path& path, const std::string& content) {
  fs::permissions(path, fs::perms::owner_all, fs::perm_options::add);
  write_file(path, content, Flush::none);
}

enum class Fate { refused, same, silent };

Fate fate_of(const KeptFile& file, const std::string& expected) {
  try {
    return file.read() == expected ? Fate::same : Fate::silent;
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr(file.path.filename().string()));
    EXPECT_THAT(e.what(), testing::Not(testing::HasSubstr("json.exception")));
    return Fate::refused;
  }
}

TEST(DamagedFiles, AreRefusedOrSayTheSame) {
  const std::vector<KeptFile> files = kept_files().all();
  ASSERT_GE(files.size(), 40u);
  std::map<Fate, int> fates;
  for (std::size_t f = 0; f < files.size(); ++f) {
    const std::string whole = read_file(files[f].path), expected = files[f].read();
    Chance chance(static_cast<std::uint32_t>(f + 1));
    // The seven kinds of files that are not units have half of all.
    const int damages = static_cast<int>(f < 7 ? kDamages / 14 + 1 : kDamages / (2 * (files.size() - 7)) + 1);
    for (int k = 0; k < damages; ++k) {
      const std::string bad = damaged(whole, chance);
      overwrite(files[f].path, bad);
      const Fate fate = fate_of(files[f], expected);
      EXPECT_NE(fate, Fate::silent) << files[f].path << ", damage " << k;
      ++fates[bad == whole ? Fate::same : fate];
    }
    overwrite(files[f].path, whole);
    EXPECT_EQ(files[f].read(), expected);
  }
  EXPECT_GE(fates[Fate::refused] + fates[Fate::same], kDamages);
  EXPECT_GT(fates[Fate::refused], 9 * kDamages / 10);
}

/// Neither waited for nor read.
TEST(DamagedFiles, PipesAndFoldersInTheirPlace) {
  for (const KeptFile& file : kept_files().all()) {
    if (file.path.filename() == "baseline.json") continue;  // that may be a pipe
    const fs::path aside = file.path.string() + ".aside";
    fs::rename(file.path, aside);
    ASSERT_EQ(::mkfifo(file.path.c_str(), 0600), 0);
    EXPECT_THROW(file.read(), InputError) << file.path;
    fs::remove(file.path);
    fs::create_directory(file.path);
    EXPECT_THROW(file.read(), InputError) << file.path;
    fs::remove(file.path);
    fs::rename(aside, file.path);
  }
}

/// The program itself: its commands on damaged files end with an exit code and name what is wrong, or print what they print of
/// whole ones.
class DamagedFilesInCommands : public testing::Test {
 protected:
  using Arguments = std::vector<std::string>;

  void expect_no_silent_use(const fs::path& path, const Arguments& arguments, int damages) {
    const std::string whole = read_file(path);
    const SubprocessResult before = files_.ddem(arguments);
    Chance chance(99);
    for (int k = 0; k < damages; ++k) {
      overwrite(path, damaged(whole, chance));
      const SubprocessResult run = files_.ddem(arguments);
      EXPECT_EQ(run.signal, 0) << arguments.front() << " " << path << " " << k;
      const bool same = run.exit_code == before.exit_code && run.standard_output == before.standard_output;
      const bool named = run.standard_error.find(path.filename().string()) != std::string::npos;
      EXPECT_TRUE(same || named) << arguments.front() << " " << path << " " << k << ": exit " << run.exit_code << "\n" << run.standard_error;
    }
    overwrite(path, whole);
  }

  const KeptFiles& files_ = kept_files();
};

TEST_F(DamagedFilesInCommands, NothingIsUsedSilently) {
  fs::copy(files_ / "night", files_ / "copy", fs::copy_options::recursive);
  const std::string night = files_.path("copy"), baseline = files_.path("baseline.json"), nights = files_.path("nights");
  expect_no_silent_use(files_ / "copy/results.h5", {"report", night, "-o", files_.path("drawn")}, 15);
  expect_no_silent_use(files_ / "copy/summary.json", {"compare", night, baseline}, 15);
  expect_no_silent_use(files_ / "baseline.json", {"compare", night, baseline}, 15);
  expect_no_silent_use(files_ / "copy/summary.json", {"baseline", "update", night, "-o", files_.path("new.json")}, 10);
  expect_no_silent_use(fs::directory_iterator(nights)->path(), {"history", nights, "--all"}, 10);
  expect_no_silent_use(files_ / "copy/plan.json", {"merge", night, "-o", files_.path("merged")}, 5);
}

/// An older program's files have no seal: named, with what to do.
TEST_F(DamagedFilesInCommands, ResultsWithoutASeal) {
  fs::create_directory(files_ / "old");
  const std::string results = read_file(files_ / "night/results.h5");
  write_file(files_ / "old/results.h5", results.substr(0, results.size() - 77));
  const SubprocessResult run = files_.ddem({"report", files_.path("old")});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.standard_error, testing::AllOf(testing::HasSubstr("results.h5"), testing::HasSubstr("older"), testing::HasSubstr("--resume")));
}

}  // namespace
}  // namespace ddem::harness::test
