#pragma once
// Files that a reader sees whole or not at all.

#include <filesystem>
#include <string>
#include <string_view>

namespace ddem::harness {

/// Whether to wait until a file is on the disk. Without, a loss of power may leave a damaged one (a killed program does
/// not): only for what its reader checks and can make again.
enum class Flush { to_disk, none };

/// A temporary file beside the target, which takes the target's place at commit() and vanishes without it.
/// Write by append(), or let a library write to temporary_path() (then do not append, and close it before
/// commit()). A target that is a symbolic link stays one: the file it points to is replaced. Everything
/// throws MachineError with path and reason; a target that exists and is no regular file (a directory, a
/// device) is refused as InputError, since renaming would replace it.
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& temporary_path() const { return temporary_; }

  void append(std::string_view content);

  /// Flushes to the disk, renames, and flushes the directory. At most once.
  void commit(Flush flush = Flush::to_disk);

 private:
  std::filesystem::path target_, temporary_;
  int descriptor_ = -1;
  bool committed_ = false;
};

/// The whole content at once. To a device or a pipe (/dev/stdout) it is written directly.
void write_file(const std::filesystem::path& target, std::string_view content, Flush flush = Flush::to_disk);

/// The content of a file; InputError where it cannot be read.
std::string read_file(const std::filesystem::path& path);

}  // namespace ddem::harness
