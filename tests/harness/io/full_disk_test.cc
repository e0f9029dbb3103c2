// A disk that is full at any byte: the write is refused, nothing of it is left, and the earlier file is.

#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <vector>

#include "harness/io/errors.h"
#include "harness/io/hdf5.h"
#include "tests/harness/io/scratch.h"

namespace {
std::atomic<long> bytes_left{-1};  // negative: for ever
}

// Takes the place of the C library's in this program. A full disk takes what still fits.
extern "C" ssize_t write(int descriptor, const void* data, size_t size) {
  if (descriptor > 2 && bytes_left >= 0) {
    if (bytes_left == 0) {
      errno = ENOSPC;
      return -1;
    }
    size = std::min(size, static_cast<size_t>(bytes_left.load()));
    bytes_left -= static_cast<long>(size);
  }
  return syscall(SYS_write, descriptor, data, size);
}

namespace ddem::harness {
namespace {

/// Contiguous, chunked and deflated data, groups, attributes and texts.
void write_results(const std::filesystem::path& path) {
  std::vector<double> large(20'000);
  for (std::size_t n = 0; n < large.size(); ++n) large[n] = std::sin(1e6 * static_cast<double>(n));
  Hdf5File file = Hdf5File::create(path);
  Hdf5Group root = file.root();
  root.set_attribute("scene", std::string(5000, 's'));
  for (int k = 0; k < 20; ++k) {
    Hdf5Group group = root.create_group("group " + std::to_string(k));
    group.write("small", std::span(large).first(100)).set_attribute("unit", "m");
    group.write("texts", std::vector<std::string>{"a", std::string(100, 'b')});
  }
  root.write("large", large);
  file.close();
}

TEST(FullDisk, AtAnyByteIsAnErrorAndLeavesWhatWasThere) {
  const Scratch scratch;
  const std::filesystem::path path = scratch / "results.h5";
  write_results(path);
  const std::string earlier = content_of(path);
  const auto size = static_cast<long>(earlier.size());
  ASSERT_GT(size, 150'000);
  for (long fits = 0; fits < size; fits += fits < 3000 ? 97 : 4999) {
    bytes_left = fits;
    const std::string reason = message_of<MachineError>([&] { write_results(path); });
    bytes_left = -1;
    EXPECT_NE(reason.find("results.h5"), std::string::npos) << reason;
    EXPECT_NE(reason.find("No space left"), std::string::npos) << reason;
    EXPECT_EQ(scratch.entries(), 1) << fits;
    ASSERT_EQ(content_of(path), earlier) << fits;
  }
  bytes_left = size;
  EXPECT_NO_THROW(write_results(path));
  bytes_left = -1;
  EXPECT_EQ(content_of(path).size(), earlier.size());
}

}  // namespace
}  // namespace ddem::harness
