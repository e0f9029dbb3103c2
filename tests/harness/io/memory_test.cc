// How much memory is left, on machines that are made up.

#include "harness/io/memory.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <fstream>

#include "harness/io/temporary_folder.h"

namespace ddem::harness {
namespace {

class Memory : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const {
    const auto file = root_.path() / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }
  double available(double address_space = HUGE_VAL) const { return available_memory(root_.path(), address_space); }

  void SetUp() override { write("proc/meminfo", "MemTotal:       16000000 kB\nMemFree: 1 kB\nMemAvailable:    8000000 kB\n"); }

 private:
  TemporaryFolder root_{"ddem-memory-test"};
};

TEST_F(Memory, IsWhatTheMachineHasFree) { EXPECT_EQ(available(), 8000000.0 * 1024.0); }

TEST_F(Memory, IsNoMoreThanTheAddressSpaceLeaves) {
  write("proc/self/statm", "1000 10 5 1 0 5 0\n");
  EXPECT_EQ(available(5e9), 5e9 - 1000.0 * static_cast<double>(sysconf(_SC_PAGESIZE)));
  EXPECT_EQ(available(1.0), 0.0);
}

TEST_F(Memory, IsNoMoreThanAnyControlGroupAboveLeaves) {
  write("proc/self/cgroup", "0::/night/job\n");
  write("sys/fs/cgroup/night/job/memory.max", "max\n");
  write("sys/fs/cgroup/night/job/memory.current", "1000\n");
  write("sys/fs/cgroup/night/memory.max", "3000000\n");
  write("sys/fs/cgroup/night/memory.current", "2500000\n");
  EXPECT_EQ(available(), 500000.0);
  write("sys/fs/cgroup/night/memory.stat", "anon 1\ninactive_file 200000\n");  // given back when asked for
  EXPECT_EQ(available(), 700000.0);
}

TEST_F(Memory, OfControlGroupsOfTheFirstVersion) {
  write("proc/self/cgroup", "4:memory:/box/inner\n1:cpu:/\n");
  write("sys/fs/cgroup/memory/memory.limit_in_bytes", "4000000\n");  // of the mount that a container sees
  write("sys/fs/cgroup/memory/memory.usage_in_bytes", "1000000\n");
  write("sys/fs/cgroup/memory/memory.stat", "total_inactive_file 500\n");
  EXPECT_EQ(available(), 3000500.0);
}

TEST_F(Memory, OfThisProcessIsSomeAndNotAll) {
  EXPECT_GT(available_memory(), 1e6);
  EXPECT_TRUE(std::isfinite(available_memory()));
  EXPECT_EQ(bytes_text(7.94e9), "7.94 GB");
  EXPECT_EQ(bytes_text(2.5e6), "2.5 MB");
}

}  // namespace
}  // namespace ddem::harness
