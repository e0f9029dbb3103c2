#include "harness/io/claim_outputs.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "harness/io/atomic_file.h"
#include "harness/io/errors.h"
#include "harness/io/streams.h"

namespace ddem::harness {
namespace {

namespace fs = std::filesystem;

std::optional<struct stat> status_of(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return std::nullopt;
  return status;
}

/// What a path is on the disk: a file, or, where none is yet, a name in a folder.
struct Place {
  dev_t device = 0;
  ino_t number = 0;
  std::string new_name;
  bool operator==(const Place&) const = default;
};

std::optional<Place> place_of(const fs::path& path) {
  if (const auto file = status_of(path)) return Place{file->st_dev, file->st_ino, ""};
  const fs::path target = target_of(path);
  const auto folder = status_of(folder_of(target));
  if (!folder) return std::nullopt;
  return Place{folder->st_dev, folder->st_ino, target.filename().string()};
}

std::string beginning_of(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw machine_error(path.string(), "is there, but cannot be read to see whether it is ddem's", errno);
  std::string bytes(kBeginningBytes, '\0');
  std::size_t size = 0;
  for (ssize_t count = 1; count > 0 && size < bytes.size(); size += static_cast<std::size_t>(count)) {
    count = ::read(descriptor, bytes.data() + size, bytes.size() - size);
    if (count < 0) count = 0;
  }
  ::close(descriptor);
  bytes.resize(size);
  return bytes;
}

/// As the kernel's protected_symlinks, which not every machine has switched on.
bool is_trap(const fs::path& path) {
  struct stat link {};
  const auto folder = status_of(folder_of(path));
  if (::lstat(path.c_str(), &link) != 0 || !S_ISLNK(link.st_mode) || !folder) return false;
  const bool of_everybody = (folder->st_mode & S_ISVTX) != 0 && (folder->st_mode & S_IWOTH) != 0;
  return of_everybody && link.st_uid != ::geteuid() && link.st_uid != folder->st_uid;
}

/// What is wrong with a path by itself; empty: nothing.
std::string problem_of_path(const fs::path& path) {
  if (path.filename().empty()) return "names no file to write to";
  if (is_trap(path)) return "is a link of another user in a folder that everybody may write to; name another file";
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0 && errno == ENAMETOOLONG)
    return "the name is longer than the file system takes (most take 255 bytes); choose a shorter one";
  const fs::path folder = folder_of(target_of(path));
  const auto there = status_of(folder);
  if (!there && (errno == ENOENT || errno == ENOTDIR))
    return fmt::format("the folder {} does not exist; create it first (mkdir -p)", folder.string());
  if (there && !S_ISDIR(there->st_mode)) return fmt::format("{} is not a folder", folder.string());
  return "";
}

/// What is wrong with replacing what is there.
std::string problem_of_content(const Output& o, bool force) {
  const auto there = status_of(o.path);
  if (!there) return "";
  if (S_ISDIR(there->st_mode)) return "is a folder; name a file";
  if (is_stream(o.path)) return is_text(o.kind) ? "" : fmt::format("{} cannot go to a device or a pipe; name a file", name_of(o.kind));
  if (!S_ISREG(there->st_mode)) return "exists and is not a regular file; name another";
  if (force || looks_like(o.kind, beginning_of(o.path))) return "";
  return fmt::format("is there, and is not {} that ddem wrote; name another file, or give --force to replace it", name_of(o.kind));
}

/// Throws MachineError where the file could not be made, or not take its place in the end.
void try_to_write(const fs::path& path) {
  const fs::path target = target_of(path);
  const auto there = status_of(target), folder = status_of(folder_of(target));
  const auto is_mine = [](const struct stat& s) { return ::geteuid() == 0 || s.st_uid == ::geteuid(); };
  if (there && folder && (folder->st_mode & S_ISVTX) != 0 && !is_mine(*there) && !is_mine(*folder))
    throw MachineError(path.string() + ": is another user's, who alone may replace it in this folder; name another file");
  const AtomicFile probe(path);
}

class Claims {
 public:
  explicit Claims(const std::vector<fs::path>& inputs) {
    for (const fs::path& input : inputs) take(input);
  }

  /// The path that has the same place; nothing where none has, and it is taken from then on.
  std::optional<fs::path> take(const fs::path& path) {
    const auto place = place_of(path);
    const auto there = status_of(path);
    if (!place || (there && !S_ISREG(there->st_mode))) return std::nullopt;  // many may write to a pipe
    for (const auto& [other, taken] : taken_) {
      if (taken == *place) return other;
    }
    taken_.emplace_back(path, *place);
    return std::nullopt;
  }

 private:
  std::vector<std::pair<fs::path, Place>> taken_;
};

}  // namespace

void claim_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error == std::errc::not_a_directory || (!error && !fs::is_directory(folder)))
    throw InputError(folder.string() + ": is a file, or lies below one; name a folder");
  if (error) throw MachineError(folder.string() + ": cannot create the folder: " + error.message() + "; name one elsewhere by its option, such as -o");
  try_to_write(folder / ".ddem-probe");
}

void claim_outputs(const std::vector<Output>& outputs, const std::vector<fs::path>& inputs, bool force) {
  const auto is_written = [](const Output& o) { return !o.path.empty(); };
  if (force && std::none_of(outputs.begin(), outputs.end(), is_written))
    throw InputError("--force: no file is written that it could replace; leave it out, or name one by -o or another option");
  std::vector<std::string> problems;
  Claims claims(inputs);
  for (const Output& o : outputs) {
    if (o.path.empty()) continue;
    std::string problem = problem_of_path(o.path);
    if (problem.empty()) {
      if (const auto other = claims.take(o.path))
        problem = fmt::format("would overwrite {}, which this command reads or writes too; name another file", other->string());
    }
    if (problem.empty()) problem = problem_of_content(o, force);
    if (!problem.empty()) problems.push_back(o.path.string() + ": " + problem);
  }
  if (!problems.empty()) throw InputError(problems);
  for (const Output& o : outputs) {
    if (!o.path.empty() && !is_stream(o.path)) try_to_write(o.path);
  }
}

}  // namespace ddem::harness
