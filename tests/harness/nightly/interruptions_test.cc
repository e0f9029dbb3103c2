// A run that is killed, or whose disk is full, or whose files cannot be renamed: 210 trials of two runs each. Whatever
// happens, a file that is read is whole, what was finished is not run again, and the resumed run has the bits
// of one without trouble.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <random>

#include "harness/io/atomic_file.h"
#include "harness/io/errors.h"
#include "tests/harness/nightly/toy_units.h"

namespace {

/// What the functions below do: fail, once `calls` (or bytes) have gone well.
struct Faults {
  std::atomic<long> bytes_left{-1}, syncs_left{-1}, renames_left{-1};  // negative: for ever
};
Faults faults;

bool spent(std::atomic<long>& left) {
  return left >= 0 && left-- <= 0;
}

}  // namespace

// These take the place of the C library's in this program.
extern "C" ssize_t write(int descriptor, const void* data, size_t size) {
  if (descriptor > 2 && faults.bytes_left >= 0) {
    if (faults.bytes_left == 0) {
      errno = ENOSPC;
      return -1;
    }
    size =
        std::min(size, static_cast<size_t>(faults.bytes_left.load()));  // a full disk takes what still fits
    faults.bytes_left -= static_cast<long>(size);
  }
  return syscall(SYS_write, descriptor, data, size);
}

extern "C" int fsync(int descriptor) {
  struct stat status {};
  const bool directory = ::fstat(descriptor, &status) == 0 && S_ISDIR(status.st_mode);
  // Some file systems never flush a directory, which ends no run: only flushes of files are counted, so that
  // whether a run is hit does not depend on the order of its threads.
  if (directory ? faults.syncs_left >= 0 : spent(faults.syncs_left)) {
    errno = directory ? EINVAL : EIO;
    return -1;
  }
  return 0;  // of what is written and what a reader sees, no power is cut here
}

extern "C" int rename(const char* from, const char* to) noexcept {
  if (spent(faults.renames_left)) {
    errno = EACCES;
    return -1;
  }
  return static_cast<int>(syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}

namespace ddem::harness::nightly {
namespace {

constexpr std::size_t kUnits = 24;

class Interruptions : public testing::Test {
 protected:
  void TearDown() override { faults.bytes_left = faults.syncs_left = faults.renames_left = -1; }

  /// Units whose result is on the disk, whole.
  std::vector<bool> finished(const Scratch& folder) const {
    std::vector<bool> whole(kUnits, false);
    for (std::size_t k = 0; k < kUnits; ++k) {
      try {
        whole[k] = read_unit(folder / "", plan_.units[k].id, plan_.units[k].identity).outcome.failure.empty();
      } catch (const InputError&) {
      }
    }
    return whole;
  }

  /// Half written files have names of their own, and no reader looks at them.
  static void expect_no_torn_file(const Scratch& folder) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / "")) {
      if (entry.path().extension() != ".unit") continue;
      EXPECT_NO_THROW(parse_unit(content_of(entry.path()), entry.path().string()));
    }
  }

  void expect_resumed(const Scratch& folder) const {
    expect_no_torn_file(folder);
    const std::vector<bool> before = finished(folder);
    std::vector<std::atomic<int>> runs(kUnits);
    EXPECT_EQ(outcomes_of(toy_units(kUnits, &runs), {.folder = folder / "", .jobs = 2, .resume = true}),
              whole_);
    for (std::size_t k = 0; k < kUnits; ++k) EXPECT_EQ(runs[k], before[k] ? 0 : 1) << k;
    EXPECT_EQ(outcomes_in(folder / "", units_), whole_);
  }

  /// Runs with the faults that are set; whether they struck.
  bool run_is_hit(const Scratch& folder, bool resume) const {
    bool hit = false;
    try {
      outcomes_of(units_, {.folder = folder / "", .jobs = 2, .resume = resume});
    } catch (const MachineError&) {
      hit = true;
    }
    faults.bytes_left = faults.syncs_left = faults.renames_left = -1;
    return hit;
  }

  std::vector<Unit> units_ = toy_units(kUnits);
  Plan plan_ = toy_plan(units_);
  Outcomes whole_ = outcomes_of(units_, {});
  std::mt19937 random_{7};
};

/// A kill at any time, resumed runs among them.
TEST_F(Interruptions, Killed) {
  std::vector<Unit> slow = units_;
  for (Unit& u : slow) {
    u.run = [run = u.run] {
      ::usleep(200);
      return run();
    };
  }
  int unfinished = 0;
  for (int trial = 0; trial < 70; ++trial) {
    const Scratch folder;
    for (const bool resume : {false, true}) {
      const pid_t child = ::fork();
      if (child == 0) {
        outcomes_of(slow, {.folder = folder / "", .resume = resume});
        ::_exit(0);
      }
      ::usleep(std::uniform_int_distribution<unsigned>(0, 8000)(random_));
      ::kill(child, SIGKILL);
      ::waitpid(child, nullptr, 0);
      const std::vector<bool> done = finished(folder);
      unfinished += std::count(done.begin(), done.end(), false) > 0;
    }
    expect_resumed(folder);
  }
  EXPECT_GT(unfinished, 35);  // of 140: it was killed while it ran
}

TEST_F(Interruptions, DiskFull) {
  int hits = 0;
  for (int trial = 0; trial < 70; ++trial) {
    const Scratch folder;
    for (const bool resume : {false, true}) {
      faults.bytes_left = std::uniform_int_distribution<long>(0, 12000)(random_);  // all of them take 15 kB
      hits += run_is_hit(folder, resume);
    }
    expect_resumed(folder);
  }
  EXPECT_GT(hits, 70);
}

TEST_F(Interruptions, RenamesFail) {
  int hits = 0;
  for (int trial = 0; trial < 70; ++trial) {
    const Scratch folder;
    for (const bool resume : {false, true}) {
      faults.renames_left = std::uniform_int_distribution<long>(0, kUnits - 1)(random_);
      hits += run_is_hit(folder, resume);
    }
    expect_resumed(folder);
  }
  EXPECT_GT(hits, 70);
}

/// Files that are flushed; those of units are not, and found damaged where that mattered (unit_file_test.cc).
TEST_F(Interruptions, FlushesFail) {
  const Scratch folder;
  const std::filesystem::path file = folder / "file";
  write_file(file, "earlier");
  faults.syncs_left = 0;
  EXPECT_THROW(write_file(file, "later"), MachineError);
  EXPECT_EQ(read_file(file), "earlier");
  write_file(file, "unflushed", Flush::none);
  EXPECT_EQ(read_file(file), "unflushed");
}

/// The earlier result is there until the new one is whole.
TEST_F(Interruptions, ARunAnewDestroysNothing) {
  const Scratch folder;
  outcomes_of(units_, {.folder = folder / ""});
  for (int trial = 0; trial < 20; ++trial) {
    faults.bytes_left = 100 * trial;
    EXPECT_TRUE(run_is_hit(folder, false));
    EXPECT_EQ(outcomes_in(folder / "", units_), whole_);
  }
}

}  // namespace
}  // namespace ddem::harness::nightly
