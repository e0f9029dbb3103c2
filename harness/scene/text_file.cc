#include "harness/scene/text_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>
#include <optional>

namespace ddem::harness {
namespace {

constexpr int patience_ms = 10'000;

class Descriptor {
 public:
  // Of a pipe without a writer, opening would wait for ever; reading it then finds its end at once.
  explicit Descriptor(const std::filesystem::path& path) : number_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  operator int() const { return number_; }

 private:
  int number_;
};

struct Refusal {
  std::string message, remedy;
};

/// What a file is that is neither a file nor a pipe that may be read.
std::optional<Refusal> wrong_kind(const struct stat& status, Pipes pipes) {
  if (S_ISREG(status.st_mode)) return std::nullopt;
  if (S_ISDIR(status.st_mode)) return Refusal{"this is a folder", "name a file in it"};
  if (!S_ISFIFO(status.st_mode)) return Refusal{"this is a device, not a file", "name a file"};
  if (pipes == Pipes::refused) return Refusal{"this is a pipe, not a file", "write what comes through it to a file, and name that"};
  return std::nullopt;
}

Refusal unreadable(int error) { return {fmt::format("cannot be read: {}", std::strerror(error)), "check the name"}; }

/// Appends all that there is to `text`.
std::optional<Refusal> read_all(int file, std::size_t expected, std::size_t max_bytes, std::string& text) {
  std::size_t room = std::min(expected, max_bytes);
  while (true) {
    pollfd wait{file, POLLIN, 0};
    if (::poll(&wait, 1, patience_ms) == 0) return Refusal{"nothing came through this pipe in ten seconds", "is something writing to it?"};
    constexpr std::size_t smallest_read = std::size_t{1} << 16;
    const std::size_t filled = text.size();
    text.resize(filled + std::max(room + 1, smallest_read));
    room = 0;
    const ssize_t got = ::read(file, text.data() + filled, text.size() - filled);
    const int error = errno;
    text.resize(filled + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    if (got < 0 && (error == EINTR || error == EAGAIN)) continue;
    if (got < 0) return unreadable(error);
    if (text.size() > max_bytes) return Refusal{fmt::format("larger than {} MiB", max_bytes >> 20), "is it the right file?"};
    if (got == 0) return std::nullopt;
  }
}

}  // namespace

Checked<std::string> read_text_file(const std::filesystem::path& path, std::size_t max_bytes, Pipes pipes) {
  std::string text;
  const auto read = [&]() -> std::optional<Refusal> {
    struct stat status {};
    // Devices are not even opened: that alone may do something.
    if (::stat(path.c_str(), &status) != 0) return unreadable(errno);
    if (auto wrong = wrong_kind(status, pipes)) return wrong;
    const Descriptor file(path);
    if (file < 0) return unreadable(errno);
    if (S_ISREG(status.st_mode) && static_cast<std::uintmax_t>(status.st_size) > max_bytes)
      return Refusal{fmt::format("larger than {} MiB", max_bytes >> 20), "is it the right file?"};
    try {
      return read_all(file, static_cast<std::size_t>(status.st_size), max_bytes, text);
    } catch (const std::bad_alloc&) {
      return Refusal{"larger than the memory that is left", "is it the right file?"};
    }
  };
  if (auto refusal = read()) return Violations{{path.string(), 0, 0, "", "", std::move(refusal->message), std::move(refusal->remedy)}};
  return text;
}

}  // namespace ddem::harness
