#pragma once
// The largest file that this process may write.

#include <sys/resource.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>

namespace ddem::fem {

/// Bytes; the largest number where nothing limits them.
inline std::uint64_t file_size_limit() {
  rlimit limit{};
  const bool limited = getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  return limited ? limit.rlim_cur : std::numeric_limits<std::uint64_t>::max();
}

/// What became of a file: the system's words, and of one that is too large the limit, where it is the process's.
inline std::string file_error_text(int error) {
  std::string text = std::strerror(error);
  if (error != EFBIG || file_size_limit() == std::numeric_limits<std::uint64_t>::max()) return text;
  return text + " (this process may write files of " + std::to_string(file_size_limit()) + " bytes: ulimit -f)";
}

}  // namespace ddem::fem
