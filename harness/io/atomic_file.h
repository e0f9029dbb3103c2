#pragma once
// Files that a reader sees whole or not at all.

#include <sys/stat.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "harness/io/leftovers.h"

namespace ddem::harness {

/// Whether to wait until a file is on the disk. Without, a loss of power may leave a damaged one (a killed program does
/// not): only for what its reader checks and can make again.
enum class Flush { to_disk, none };

/// Where the symbolic links of a path lead, even where nothing is there yet: renaming then replaces the file, and not the
/// link. Throws MachineError.
std::filesystem::path target_of(std::filesystem::path path);

/// A temporary file beside the target, which takes the target's place at commit() and vanishes without it.
/// Write by append(), or let a library write to temporary_path() (then do not append, and close it before
/// commit()). A target that is a symbolic link stays one: the file it points to is replaced, or made. The new file has the
/// permissions of the one it replaces, and its owner where this user may give it away; a further hard link to that keeps the
/// old content. Signals that end the process remove the temporary file; what a killed process left is removed by the
/// next that writes into the folder. Everything
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
  void open_beside();
  void rename_into_place();

  std::filesystem::path target_, temporary_;
  std::optional<struct stat> replaced_;
  Leftover leftover_;
  int descriptor_ = -1;
  bool committed_ = false;
};

/// The whole content at once. To a device, a pipe or an open descriptor (/dev/stdout) it is written directly.
void write_file(const std::filesystem::path& target, std::string_view content, Flush flush = Flush::to_disk);

/// That a file is in: "." where its name says none.
std::filesystem::path folder_of(const std::filesystem::path& file);

/// The content of a file; InputError where it cannot be read.
std::string read_file(const std::filesystem::path& path);

}  // namespace ddem::harness
