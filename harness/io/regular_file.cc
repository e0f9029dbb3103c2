#include "harness/io/regular_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "harness/io/errors.h"

namespace ddem::harness {
namespace {

constexpr off_t kMostBytes = off_t{1} << 32;

class Descriptor {
 public:
  Descriptor(const std::filesystem::path& path, int flags) : fd_(::open(path.c_str(), flags | O_RDONLY | O_CLOEXEC)) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }

 private:
  int fd_;
};

bool is_own(const struct stat& status) {
  return (status.st_uid == ::geteuid() || status.st_uid == 0) && (status.st_mode & S_IWOTH) == 0;
}

}  // namespace

std::string read_regular_file(const std::filesystem::path& path, Trust trust) {
  const auto refused = [&](int error_number) {
    return InputError(fmt::format("{}: cannot read: {}", path.string(), std::generic_category().message(error_number)));
  };
  // A pipe that nobody writes to opens at once, and is then seen to be one.
  const Descriptor file(path, O_NONBLOCK | (trust == Trust::own ? O_NOFOLLOW : 0));
  struct stat status {};
  if (file.get() < 0 || ::fstat(file.get(), &status) != 0) throw refused(errno);
  if (!S_ISREG(status.st_mode)) throw InputError(path.string() + ": cannot read: it is not a regular file");
  if (trust == Trust::own && !is_own(status))
    throw InputError(path.string() + ": not read: it is another user's, or writable to all");
  if (status.st_size > kMostBytes) throw InputError(path.string() + ": not read: it is larger than anything that ddem keeps");
  std::string content(static_cast<std::size_t>(status.st_size), '\0');
  std::size_t filled = 0;
  while (filled < content.size()) {
    const ssize_t count = ::read(file.get(), content.data() + filled, content.size() - filled);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw refused(errno);
    if (count == 0) break;
    filled += static_cast<std::size_t>(count);
  }
  content.resize(filled);
  return content;
}

}  // namespace ddem::harness
