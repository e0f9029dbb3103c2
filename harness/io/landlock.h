#pragma once
// Where a program may write.

#include <filesystem>
#include <vector>

namespace ddem::harness {

/// A rule for the calling thread of a forked child, made before the fork: below these folders alone, and on devices, files may be
/// written, made or removed. Without effect where the system has no Landlock (Linux 5.13 and later have it).
class WriteRule {
 public:
  explicit WriteRule(const std::vector<std::filesystem::path>& folders);
  ~WriteRule();
  WriteRule(const WriteRule&) = delete;
  WriteRule& operator=(const WriteRule&) = delete;

  /// Only system calls. Whatever this process becomes keeps to the rule, and so does all that it starts.
  void apply() const;

 private:
  int rule_ = -1;
};

}  // namespace ddem::harness
