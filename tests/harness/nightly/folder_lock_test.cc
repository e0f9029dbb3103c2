// One writer a folder, and no lock that outlives its process.

#include "harness/io/folder_lock.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <string>

#include "harness/io/errors.h"
#include "tests/harness/io/scratch.h"

namespace ddem::harness {
namespace {

TEST(FolderLock, TheSecondIsToldWhoHoldsIt) {
  const Scratch scratch;
  {
    const FolderLock first(scratch / "");
    const auto message = message_of<InputError>([&] { FolderLock second(scratch / ""); });
    EXPECT_NE(message.find(std::to_string(::getpid())), std::string::npos) << message;
    EXPECT_NE(message.find("-o"), std::string::npos) << message;
  }
  EXPECT_NO_THROW(FolderLock(scratch / ""));
}

TEST(FolderLock, OfAKilledProcessIsFree) {
  const Scratch scratch;
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const FolderLock held(scratch / "");
    [[maybe_unused]] const ssize_t told = ::write(ready[1], "x", 1);
    ::pause();
    ::_exit(0);
  }
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  const auto message = message_of<InputError>([&] { FolderLock second(scratch / ""); });
  EXPECT_NE(message.find(std::to_string(child)), std::string::npos) << message;
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_NO_THROW(FolderLock(scratch / ""));
  ::close(ready[0]);
  ::close(ready[1]);
}

TEST(FolderLock, NeverWritesThroughLinks) {
  const Scratch scratch;
  put(scratch / "thesis.txt", "precious");
  const auto refuse = [&] {
    const auto message = message_of<InputError>([&] { FolderLock lock(scratch / ""); });
    EXPECT_NE(message.find(".lock"), std::string::npos) << message;
    EXPECT_EQ(content_of(scratch / "thesis.txt"), "precious");
    std::filesystem::remove(scratch / ".lock");
  };
  std::filesystem::create_symlink("thesis.txt", scratch / ".lock");
  refuse();
  std::filesystem::create_hard_link(scratch / "thesis.txt", scratch / ".lock");
  refuse();
  std::filesystem::create_symlink("not_there", scratch / ".lock");
  refuse();
  EXPECT_FALSE(std::filesystem::exists(scratch / "not_there"));
  ASSERT_EQ(::mkfifo((scratch / ".lock").c_str(), 0666), 0);
  refuse();
  // A file of that name that somebody else keeps there serves, and stays as it is.
  put(scratch / ".lock", "do not touch");
  { const FolderLock lock(scratch / ""); }
  EXPECT_EQ(content_of(scratch / ".lock"), "do not touch");
}

TEST(FolderLock, WhereNothingCanBeWritten) {
  EXPECT_THROW(FolderLock("/nowhere/at/all"), MachineError);
}

}  // namespace
}  // namespace ddem::harness
