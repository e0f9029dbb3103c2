#pragma once
// A folder for exchange with another program, gone when done.

#include <filesystem>
#include <string>

namespace ddem::harness {

class TemporaryFolder {
 public:
  /// Below the system's folder for temporary files (TMPDIR). Throws MachineError.
  explicit TemporaryFolder(const std::string& prefix);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace ddem::harness
