#pragma once
// A folder for exchange with another program, gone when done.

#include <filesystem>
#include <string>

#include "harness/io/leftovers.h"

namespace ddem::harness {

class TemporaryFolder {
 public:
  /// Below the system's folder for temporary files (TMPDIR), where it also removes what killed processes left. Throws
  /// MachineError. A signal that ends the process removes the folder; `prefix` begins with "ddem-".
  explicit TemporaryFolder(const std::string& prefix);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  Leftover leftover_;
};

}  // namespace ddem::harness
