#include "harness/io/folder_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string>

#include "harness/io/errors.h"

namespace ddem::harness {
namespace {

constexpr int kRetries = 40;
constexpr unsigned kRetryMicroseconds = 25000;

/// The file itself, not what a link to it would lead to.
int open_lock(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
  struct stat status {};
  const bool is_link = descriptor < 0 && errno == ELOOP;
  if (descriptor < 0 && !is_link) throw machine_error(path, "cannot open", errno);
  if (!is_link && ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) && status.st_nlink <= 1) return descriptor;
  if (descriptor >= 0) ::close(descriptor);
  throw InputError(path + ": is a link or no file of ddem's; remove it, or give another folder by -o");
}

/// For the message to whoever comes second. A full disk does not matter, and what holds anything but a number is not ours.
void write_holder(int descriptor) {
  char there[64] = {};
  const ssize_t length = ::pread(descriptor, there, sizeof there, 0);
  if (length < 0 || !std::all_of(there, there + length, [](char c) { return c >= '0' && c <= '9'; })) return;
  const std::string self = std::to_string(::getpid());
  if (::ftruncate(descriptor, 0) != 0 || ::pwrite(descriptor, self.data(), self.size(), 0) < 0) return;
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder) {
  const std::string path = (folder / ".lock").string();
  descriptor_ = open_lock(path);
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
  write_holder(descriptor_);
}

FolderLock::~FolderLock() {
  ::close(descriptor_);
}

}  // namespace ddem::harness
