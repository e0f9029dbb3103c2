#include "harness/io/process_stamp.h"

#include <fmt/format.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <mutex>
#include <optional>
#include <set>
#include <vector>

#include "harness/io/atomic_file.h"
#include "harness/io/digest.h"
#include "harness/io/errors.h"

namespace ddem::harness {
namespace {

namespace fs = std::filesystem;

/// Empty where there is none; a process may end while its file is read.
std::string text_of(const std::string& path) {
  try {
    return read_file(path);
  } catch (const InputError&) {
    return "";
  }
}

/// Containers of one image share an id and those of one machine its name, but not both with the same numbers of processes.
const std::string& machine() {
  static const std::string hash = [] {
    char name[256] = {}, space[64] = {};
    ::gethostname(name, sizeof name - 1);
    [[maybe_unused]] const ssize_t length = ::readlink("/proc/self/ns/pid", space, sizeof space - 1);
    return sha256(fmt::format("{}\n{}\n{}", text_of("/etc/machine-id"), name, space)).substr(0, 8);
  }();
  return hash;
}

struct Status {
  char state = ' ';   ///< 'Z': it has ended, and nobody has asked how
  std::string start;  ///< in clock ticks since the machine started; empty where it cannot be known
};

Status status_of(long process) {
  const std::string status = text_of(fmt::format("/proc/{}/stat", process));
  std::size_t at = status.rfind(')');  // the program's name may hold anything
  if (at == std::string::npos || at + 2 >= status.size()) return {};
  const char state = status[at + 2];
  for (int field = 2; field < 22 && at != std::string::npos; ++field) at = status.find(' ', at + 1);
  if (at == std::string::npos) return {};
  return {state, status.substr(at + 1, status.find(' ', at + 1) - at - 1)};
}

/// The last `count` parts between dashes.
std::optional<std::vector<std::string_view>> last_parts(std::string_view name, std::size_t count) {
  std::vector<std::string_view> parts;
  while (parts.size() < count) {
    const std::size_t dash = name.rfind('-');
    if (dash == std::string_view::npos) return std::nullopt;
    parts.insert(parts.begin(), name.substr(dash + 1));
    name = name.substr(0, dash);
  }
  return parts;
}

}  // namespace

std::string process_stamp() {
  return fmt::format("{}-{}-{}", machine(), ::getpid(), status_of(::getpid()).start);
}

bool is_of_ended_process(std::string_view name) {
  if (name.ends_with(".tmp")) name.remove_suffix(4);
  const auto parts = last_parts(name, 4);
  if (!parts || (*parts)[0] != machine()) return false;
  const std::string_view number = (*parts)[1], start = (*parts)[2];
  pid_t process = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), process);
  if (error != std::errc{} || end != number.data() + number.size() || process <= 0) return false;
  if (::kill(process, 0) != 0 && errno == ESRCH) return true;
  const Status running = status_of(process);
  return running.state == 'Z' || (!running.start.empty() && !start.empty() && running.start != start);
}

void sweep_folder(const fs::path& folder, std::string_view beginning) {
  static std::mutex mutex;
  static std::set<fs::path> swept;
  {
    const std::lock_guard guard(mutex);
    if (!swept.insert(folder).second) return;
  }
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(beginning) || !is_of_ended_process(name)) continue;
    struct stat status {};
    if (::lstat(entry->path().c_str(), &status) != 0 || status.st_uid != ::geteuid()) continue;
    std::error_code ignored;
    fs::remove_all(entry->path(), ignored);
  }
}

}  // namespace ddem::harness
