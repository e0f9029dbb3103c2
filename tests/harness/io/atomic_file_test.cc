#include "harness/io/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <new>
#include <stdexcept>
#include <system_error>

#include "harness/io/errors.h"
#include "scratch.h"

namespace ddem::harness {
namespace {

namespace fs = std::filesystem;

TEST(AtomicFile, AppearsWholeAtCommit) {
  const Scratch scratch;
  put(scratch / "a.txt", "old");
  {
    AtomicFile file(scratch / "a.txt");
    file.append("new ");
    file.append("content");
    EXPECT_EQ(content_of(scratch / "a.txt"), "old");
    EXPECT_EQ(file.temporary_path().parent_path(), (scratch / "a.txt").parent_path());
    file.commit();
    EXPECT_EQ(content_of(scratch / "a.txt"), "new content");
    EXPECT_THROW(file.commit(), std::logic_error);
  }
  EXPECT_EQ(content_of(scratch / "a.txt"), "new content");
  EXPECT_EQ(scratch.entries(), 1);
}

TEST(AtomicFile, LeavesNothingWithoutCommit) {
  const Scratch scratch;
  put(scratch / "a.txt", "old");
  try {
    AtomicFile file(scratch / "a.txt");
    file.append("half");
    throw std::runtime_error("interrupted");
  } catch (const std::runtime_error&) {
  }
  EXPECT_EQ(content_of(scratch / "a.txt"), "old");
  EXPECT_EQ(scratch.entries(), 1);
}

TEST(AtomicFile, HasOrdinaryPermissions) {
  const Scratch scratch;
  const mode_t mask = ::umask(022);
  write_file(scratch / "a.txt", "x");
  ::umask(mask);
  EXPECT_EQ(fs::status(scratch / "a.txt").permissions(), static_cast<fs::perms>(0644));
}

TEST(AtomicFile, KeepsThePermissionsOfWhatItReplaces) {
  const Scratch scratch;
  for (const unsigned mode : {0600U, 0640U, 0644U, 0666U, 0444U, 0755U, 0400U}) {
    put(scratch / "a", "old");
    fs::permissions(scratch / "a", static_cast<fs::perms>(mode));
    {
      AtomicFile file(scratch / "a");
      file.append("new");
      EXPECT_EQ(fs::status(file.temporary_path()).permissions(), static_cast<fs::perms>(0600)) << "readable by others meanwhile";
      file.commit();
    }
    EXPECT_EQ(fs::status(scratch / "a").permissions(), static_cast<fs::perms>(mode));
    EXPECT_EQ(content_of(scratch / "a"), "new");
    fs::remove(scratch / "a");
  }
}

TEST(AtomicFile, KeepsTheOwnerWhereItMay) {
  if (::geteuid() != 0) GTEST_SKIP() << "needs root";
  const Scratch scratch;
  put(scratch / "a", "old");
  fs::permissions(scratch / "a", static_cast<fs::perms>(0660));
  fs::permissions(scratch / "", fs::perms::all);
  ASSERT_EQ(::chown((scratch / "a").c_str(), 12345, 54321), 0);
  write_file(scratch / "a", "by root");
  struct stat status {};
  ASSERT_EQ(::stat((scratch / "a").c_str(), &status), 0);
  EXPECT_TRUE(status.st_uid == 12345 && status.st_gid == 54321 && (status.st_mode & 0777) == 0660);
  // Another user can give it neither owner nor group: nobody gains by that.
  ASSERT_EQ(::setegid(65534) + ::seteuid(65534), 0);
  write_file(scratch / "a", "by nobody");
  ASSERT_EQ(::seteuid(0) + ::setegid(0), 0);
  ASSERT_EQ(::stat((scratch / "a").c_str(), &status), 0);
  EXPECT_TRUE(status.st_uid == 65534 && status.st_gid == 65534 && (status.st_mode & 0777) == 0600) << std::oct << status.st_mode;
}

TEST(AtomicFile, ALongNameIsAName) {
  const Scratch scratch;
  for (const std::size_t length : {200U, 230U, 254U, 255U}) {
    const std::string name(length, 'n');
    write_file(scratch / name, "x");
    EXPECT_EQ(content_of(scratch / name), "x");
  }
  const std::string odd = " -\n'\"\\\xc3\xa4\xff*$(x)";
  write_file(scratch / odd, "x");
  EXPECT_EQ(content_of(scratch / odd), "x");
  EXPECT_THROW(AtomicFile(scratch / std::string(256, 'n')), MachineError);
  EXPECT_EQ(scratch.entries(), 5);
}

TEST(AtomicFile, MakesWhatALinkPromises) {
  const Scratch scratch;
  fs::create_directories(scratch / "there/deep");
  fs::create_directory_symlink("there/deep", scratch / "way");
  fs::create_symlink("../real.txt", scratch / "there/deep/link");
  fs::create_symlink("way/link", scratch / "link_to_link");
  fs::create_symlink("nowhere/a.txt", scratch / "broken");
  fs::create_symlink("loop", scratch / "loop");
  write_file(scratch / "link_to_link", "new");
  EXPECT_TRUE(fs::is_symlink(scratch / "link_to_link") && fs::is_symlink(scratch / "there/deep/link"));
  EXPECT_EQ(content_of(scratch / "there/real.txt"), "new");
  EXPECT_THROW(write_file(scratch / "broken", "x"), MachineError);
  EXPECT_THROW(write_file(scratch / "loop", "x"), MachineError);
  EXPECT_EQ(scratch.entries(), 5);
}

TEST(AtomicFile, AHardLinkKeepsTheOldContent) {
  const Scratch scratch;
  put(scratch / "a", "old");
  fs::create_hard_link(scratch / "a", scratch / "b");
  write_file(scratch / "a", "new");
  EXPECT_EQ(content_of(scratch / "a"), "new");
  EXPECT_EQ(content_of(scratch / "b"), "old");
}

TEST(AtomicFile, KeepsSymbolicLinks) {
  const Scratch scratch;
  put(scratch / "real.txt", "old");
  fs::create_symlink("real.txt", scratch / "link.txt");
  write_file(scratch / "link.txt", "new");
  EXPECT_TRUE(fs::is_symlink(scratch / "link.txt"));
  EXPECT_EQ(content_of(scratch / "real.txt"), "new");
}

TEST(AtomicFile, TwoWritersDoNotMix) {
  const Scratch scratch;
  AtomicFile first(scratch / "a.txt"), second(scratch / "a.txt");
  first.append("first");
  second.append("second");
  second.commit();
  EXPECT_EQ(content_of(scratch / "a.txt"), "second");
  first.commit();
  EXPECT_EQ(content_of(scratch / "a.txt"), "first");
  EXPECT_EQ(scratch.entries(), 1);
}

TEST(AtomicFile, FailuresNamePathAndReason) {
  const Scratch scratch;
  put(scratch / "file", "");
  const std::string missing =
      message_of<MachineError>([&] { write_file(scratch / "no/such/place.txt", "x"); });
  EXPECT_NE(missing.find("no/such/place.txt"), std::string::npos) << missing;
  EXPECT_NE(missing.find("No such file or directory"), std::string::npos) << missing;
  const std::string not_a_directory =
      message_of<MachineError>([&] { write_file(scratch / "file/a.txt", "x"); });
  EXPECT_NE(not_a_directory.find("Not a directory"), std::string::npos) << not_a_directory;
  const std::string long_name(300, 'x');
  EXPECT_THROW(write_file(scratch / long_name, "x"), MachineError);
  // The disk is full.
  const std::string full = message_of<MachineError>([] { write_file("/dev/full", "x"); });
  EXPECT_NE(full.find("No space left on device"), std::string::npos) << full;
  EXPECT_EQ(scratch.entries(), 1);
}

TEST(AtomicFile, DirectoryRemovedMeanwhile) {
  const Scratch scratch;
  fs::create_directory(scratch / "gone");
  AtomicFile file(scratch / "gone/a.txt");
  fs::remove_all(scratch / "gone");
  EXPECT_THROW(file.commit(), MachineError);
}

TEST(AtomicFile, NeverReplacesDirectoriesOrDevices) {
  const Scratch scratch;
  EXPECT_THROW(write_file(scratch / "", "x"), InputError);
  fs::create_directory(scratch / "directory");
  EXPECT_THROW(write_file(scratch / "directory", "x"), InputError);
  EXPECT_THROW(AtomicFile("/dev/null"), InputError);
  write_file("/dev/null", "x");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_EQ(scratch.entries(), 1);
}

TEST(ReadFile, ContentOrReason) {
  const Scratch scratch;
  const std::string binary("a\0b\n\xff", 5);
  put(scratch / "a", binary);
  EXPECT_EQ(read_file(scratch / "a"), binary);
  EXPECT_THROW(read_file(scratch / "b"), InputError);
  const std::string directory = message_of<InputError>([&] { read_file(scratch / ""); });
  EXPECT_NE(directory.find("Is a directory"), std::string::npos) << directory;
}

TEST(Errors, ExitCodes) {
  EXPECT_EQ(exit_code_of(InputError("x")), ExitCode::wrong_input);
  EXPECT_EQ(exit_code_of(std::invalid_argument("x")), ExitCode::wrong_input);
  EXPECT_EQ(exit_code_of(SolverError("x")), ExitCode::solver_failed);
  EXPECT_EQ(exit_code_of(std::runtime_error("x")), ExitCode::solver_failed);
  EXPECT_EQ(exit_code_of(MachineError("x")), ExitCode::machine_failed);
  EXPECT_EQ(exit_code_of(std::bad_alloc()), ExitCode::machine_failed);
  EXPECT_EQ(exit_code_of(fs::filesystem_error("x", std::error_code())), ExitCode::machine_failed);
  EXPECT_EQ(static_cast<int>(ExitCode::machine_failed), 4);
  const InputError many(std::vector<std::string>{"first", "second"});
  EXPECT_STREQ(many.what(), "first\nsecond");
  EXPECT_EQ(many.messages().size(), 2U);
}

}  // namespace
}  // namespace ddem::harness
