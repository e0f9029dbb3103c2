#include "harness/io/folder_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <string>

#include "harness/io/errors.h"

namespace ddem::harness {
namespace {

constexpr int kRetries = 40;
constexpr unsigned kRetryMicroseconds = 25000;

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder) {
  const std::string path = (folder / ".lock").string();
  descriptor_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw machine_error(path, "cannot open", errno);
  int result = ::flock(descriptor_, LOCK_EX | LOCK_NB);
  // The children of a process that was killed follow it within moments.
  for (int k = 0; k < kRetries && result != 0 && (errno == EWOULDBLOCK || errno == EINTR); ++k) {
    ::usleep(kRetryMicroseconds);
    result = ::flock(descriptor_, LOCK_EX | LOCK_NB);
  }
  if (result != 0) {
    const int error_number = errno;
    char holder[32] = {};
    const ssize_t length = ::pread(descriptor_, holder, sizeof holder - 1, 0);
    ::close(descriptor_);
    if (error_number != EWOULDBLOCK) throw machine_error(path, "cannot lock", error_number);
    throw InputError(
        fmt::format("{}: another run{} writes into this folder; wait for it, or give another one by -o",
                    folder.string(), length > 0 ? fmt::format(" (process {})", holder) : ""));
  }
  const std::string self = std::to_string(::getpid());
  // Only for the message above: a full disk does not matter.
  if (::ftruncate(descriptor_, 0) != 0 || ::pwrite(descriptor_, self.data(), self.size(), 0) < 0) return;
}

FolderLock::~FolderLock() {
  ::close(descriptor_);
}

}  // namespace ddem::harness
