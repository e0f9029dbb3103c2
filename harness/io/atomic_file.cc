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

#include "harness/io/errors.h"
#include "harness/io/process_stamp.h"
#include "harness/io/streams.h"

namespace ddem::harness {
namespace {

namespace fs = std::filesystem;

constexpr int kMostLinks = 40;
constexpr std::string_view kBeginning = ".ddem-";  // of temporary files

/// Of the file that is there; nothing where none is.
std::optional<struct stat> require_replaceable(const fs::path& target) {
  if (target.filename().empty())
    throw InputError(fmt::format("'{}' names no file to write to", target.string()));
  struct stat status {};
  if (::lstat(target.c_str(), &status) == 0) {
    if (S_ISREG(status.st_mode)) return status;
    throw InputError(
        fmt::format("{}: cannot be written to: it exists and is not a regular file", target.string()));
  }
  if (errno == ENAMETOOLONG) throw machine_error(target.string(), "cannot create a file there", errno);
  return std::nullopt;
}

/// Gives the new file the permissions of the one that it replaces, and its owner where this user may. A group that cannot be
/// kept gets no more than everybody has.
void inherit(int descriptor, const struct stat& replaced) {
  mode_t mode = replaced.st_mode & 0777;
  if (::fchown(descriptor, replaced.st_uid, replaced.st_gid) != 0 &&
      ::fchown(descriptor, static_cast<uid_t>(-1), replaced.st_gid) != 0) {
    mode = (mode & ~static_cast<mode_t>(070)) | (mode & 07) << 3;
  }
  ::fchmod(descriptor, mode);  // a file system without permissions has none to keep
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
  const int descriptor = ::open(folder_of(file).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

fs::path target_of(fs::path target) {
  const fs::path named = target;
  for (int links = 0; links < kMostLinks; ++links) {
    std::error_code error;
    if (!fs::is_symlink(fs::symlink_status(target, error))) return target;
    const fs::path to = fs::read_symlink(target, error);
    if (error) throw machine_error(named.string(), "cannot follow the symbolic link", error.value());
    target = to.is_absolute() ? to : target.parent_path() / to;
  }
  throw machine_error(named.string(), "cannot follow the symbolic link", ELOOP);
}

fs::path folder_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

AtomicFile::AtomicFile(const fs::path& target) : target_(target_of(target)) {
  if (own_descriptor(target)) throw InputError(target.string() + ": is an open stream; name a file");
  replaced_ = require_replaceable(target_);
  sweep_folder(folder_of(target_), kBeginning);
  open_beside();
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (committed_) return;
  CleanupSection section;
  ::unlink(leftover_.path.c_str());
  section.unlist(leftover_);
}

/// A name that no other process or thread uses, and not longer for a long one's sake. A new file has the permissions that the
/// user's umask grants; one that replaces another is this user's alone until it has those of the other.
void AtomicFile::open_beside() {
  static std::atomic<unsigned> counter{0};
  const mode_t mode = replaced_ ? 0600 : 0666;
  for (const std::string stamp = process_stamp();;) {
    temporary_ = target_;
    temporary_.replace_filename(fmt::format("{}{}-{}.tmp", kBeginning, stamp, counter++));
    leftover_.path = fs::absolute(temporary_).string();  // the working folder may be another by then
    int error = 0;
    {
      CleanupSection section;
      descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
      error = errno;
      if (descriptor_ >= 0) return section.list(leftover_);
    }
    if (error != EEXIST && error != EINTR) throw machine_error(target_.string(), "cannot create a file there", error);
  }
}

void AtomicFile::append(std::string_view content) {
  if (committed_) throw std::logic_error("append to a committed file");
  write_all(descriptor_, content, target_);
}

void AtomicFile::commit(Flush flush) {
  if (committed_) throw std::logic_error("a file can be committed only once");
  if (replaced_) inherit(descriptor_, *replaced_);
  if (flush == Flush::to_disk) flush_file(temporary_, target_);
  const int close_error = ::close(descriptor_) == 0 ? 0 : errno;
  descriptor_ = -1;
  if (close_error != 0 && close_error != EINTR)
    throw machine_error(target_.string(), "cannot close", close_error);
  rename_into_place();
  if (flush == Flush::to_disk) flush_directory(target_);
}

void AtomicFile::rename_into_place() {
  int error = 0;
  {
    CleanupSection section;
    error = ::rename(temporary_.c_str(), target_.c_str()) == 0 ? 0 : errno;
    if (error == 0) section.unlist(leftover_);
  }
  if (error != 0) throw machine_error(target_.string(), "cannot put the finished file in place", error);
  committed_ = true;
}

void write_file(const fs::path& target, std::string_view content, Flush flush) {
  if (is_stream(target)) return write_to_stream(target, content);
  AtomicFile file(target);
  file.append(content);
  file.commit(flush);
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
