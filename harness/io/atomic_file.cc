#include "harness/io/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <stdexcept>
#include <string>
#include <system_error>
#include <tuple>
#include <utility>

#include "harness/io/errors.h"

namespace ddem::harness {
namespace {

namespace fs = std::filesystem;

void write_all(int descriptor, std::string_view content, const fs::path& path) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor, content.data(), content.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      throw machine_error(path.string(), "cannot write", errno);
    }
    content.remove_prefix(static_cast<std::size_t>(written));
  }
}

/// Follows symbolic links, so that renaming replaces the file and not the link.
fs::path resolved(const fs::path& target) {
  std::error_code ignored;
  if (!fs::is_symlink(target, ignored)) return target;
  std::error_code error;
  fs::path real = fs::weakly_canonical(target, error);
  if (error) throw machine_error(target.string(), "cannot follow the symbolic link", error.value());
  return real;
}

bool is_stream(const fs::path& target) {
  struct stat status {};
  return ::stat(target.c_str(), &status) == 0 && (S_ISCHR(status.st_mode) || S_ISFIFO(status.st_mode));
}

void require_replaceable(const fs::path& target) {
  if (target.filename().empty())
    throw InputError(fmt::format("'{}' names no file to write to", target.string()));
  struct stat status {};
  if (::stat(target.c_str(), &status) == 0 && !S_ISREG(status.st_mode))
    throw InputError(
        fmt::format("{}: cannot be written to: it exists and is not a regular file", target.string()));
}

/// A name that no other process or thread uses; opened with the permissions that the user's umask grants.
std::pair<fs::path, int> open_beside(const fs::path& target) {
  static std::atomic<unsigned> counter{0};
  for (;;) {
    fs::path candidate = target;
    candidate.replace_filename(
        fmt::format(".{}.{}-{}.tmp", target.filename().string(), ::getpid(), counter++));
    const int descriptor = ::open(candidate.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) return {candidate, descriptor};
    // A crashed process with the same number may have left the name behind.
    if (errno != EEXIST && errno != EINTR)
      throw machine_error(target.string(), "cannot create a file there", errno);
  }
}

/// fsync reaches what a library has written through a descriptor of its own, too: it is the same file. Opened anew, since
/// a library may have replaced it.
void flush_file(const fs::path& temporary, const fs::path& target) {
  const int descriptor = ::open(temporary.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw machine_error(target.string(), "the file written beside it has vanished", errno);
  const int error = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  if (error != 0) throw machine_error(target.string(), "cannot flush to the disk", error);
}

/// A rename is on the disk once its directory is. Some file systems refuse, and then there is nothing to be
/// done.
void flush_directory(const fs::path& file) {
  const fs::path directory = file.has_parent_path() ? file.parent_path() : fs::path(".");
  const int descriptor = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

AtomicFile::AtomicFile(const fs::path& target) : target_(resolved(target)) {
  require_replaceable(target_);
  std::tie(temporary_, descriptor_) = open_beside(target_);
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!committed_) ::unlink(temporary_.c_str());
}

void AtomicFile::append(std::string_view content) {
  if (committed_) throw std::logic_error("append to a committed file");
  write_all(descriptor_, content, target_);
}

void AtomicFile::commit(Flush flush) {
  if (committed_) throw std::logic_error("a file can be committed only once");
  if (flush == Flush::to_disk) flush_file(temporary_, target_);
  const int close_error = ::close(descriptor_) == 0 ? 0 : errno;
  descriptor_ = -1;
  if (close_error != 0 && close_error != EINTR)
    throw machine_error(target_.string(), "cannot close", close_error);
  if (::rename(temporary_.c_str(), target_.c_str()) != 0)
    throw machine_error(target_.string(), "cannot put the finished file in place", errno);
  committed_ = true;
  if (flush == Flush::to_disk) flush_directory(target_);
}

void write_file(const fs::path& target, std::string_view content, Flush flush) {
  if (!is_stream(target)) {
    AtomicFile file(target);
    file.append(content);
    file.commit(flush);
    return;
  }
  const int descriptor = ::open(target.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) throw machine_error(target.string(), "cannot open", errno);
  try {
    write_all(descriptor, content, target);
  } catch (...) {
    ::close(descriptor);
    throw;
  }
  ::close(descriptor);
}

std::string read_file(const fs::path& path) {
  const auto refused = [&](int error_number) {
    return InputError(
        fmt::format("{}: cannot read: {}", path.string(), std::generic_category().message(error_number)));
  };
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw refused(errno);
  std::string content;
  std::string block(1 << 16, '\0');
  for (;;) {
    const ssize_t count = ::read(descriptor, block.data(), block.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      const int error_number = errno;
      ::close(descriptor);
      throw refused(error_number);
    }
    if (count == 0) break;
    content.append(block, 0, static_cast<std::size_t>(count));
  }
  ::close(descriptor);
  return content;
}

}  // namespace ddem::harness
