#include "harness/io/streams.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <string>

#include "harness/io/errors.h"

namespace ddem::harness {
namespace {

namespace fs = std::filesystem;

constexpr int kMostHops = 40;

bool same_place(const struct stat& a, const struct stat& b) {
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

}  // namespace

void prepare_streams() {
  for (int descriptor = 0; descriptor <= 2; ++descriptor) {
    if (::fcntl(descriptor, F_GETFD) >= 0 || errno != EBADF) continue;
    // The lowest that is free is the one. Data must not seem written, so standard output can then only be read.
    [[maybe_unused]] const int opened = ::open("/dev/null", descriptor == 2 ? O_WRONLY : O_RDONLY);
  }
  ::signal(SIGPIPE, SIG_IGN);
  ::signal(SIGXFSZ, SIG_IGN);
}

void finish_standard_output() {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  if (errno != 0) throw machine_error("standard output", "cannot be written", errno);
  throw MachineError("standard output: cannot be written");
}

std::optional<int> own_descriptor(const fs::path& path) {
  struct stat descriptors {};
  if (::stat("/proc/self/fd", &descriptors) != 0) return std::nullopt;
  fs::path place = path;
  for (int links = 0; links < kMostHops; ++links) {
    const std::string name = place.filename().string();
    struct stat folder {};
    if (::stat(place.has_parent_path() ? place.parent_path().c_str() : ".", &folder) == 0 && same_place(folder, descriptors)) {
      int descriptor = -1;
      const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), descriptor);
      if (error == std::errc{} && end == name.data() + name.size()) return descriptor;
    }
    std::error_code error;
    if (!fs::is_symlink(fs::symlink_status(place, error))) return std::nullopt;
    const fs::path to = fs::read_symlink(place, error);
    place = to.is_absolute() ? to : place.parent_path() / to;
  }
  return std::nullopt;
}

bool is_stream(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0 && (S_ISCHR(status.st_mode) || S_ISFIFO(status.st_mode))) return true;
  return own_descriptor(path).has_value();
}

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

void write_to_stream(const fs::path& path, std::string_view content) {
  const std::optional<int> own = own_descriptor(path);
  if (own == STDOUT_FILENO) std::fflush(stdout);  // what was printed before stands before
  const int descriptor = own ? ::fcntl(*own, F_DUPFD_CLOEXEC, 3) : ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) throw machine_error(path.string(), "cannot open", errno);
  try {
    write_all(descriptor, content, path);
  } catch (...) {
    ::close(descriptor);
    throw;
  }
  ::close(descriptor);
}

}  // namespace ddem::harness
