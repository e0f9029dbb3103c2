#pragma once
// One writer a folder.

#include <filesystem>

namespace ddem::harness {

/// Holds FOLDER/.lock while it lives. A process that dies lets go of it, however it dies. Throws InputError,
/// naming the process that holds it, where another one writes there, or where .lock is a link; MachineError where the file
/// cannot be made.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace ddem::harness
