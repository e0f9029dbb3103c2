#pragma once
// For tests of the solver in Python.

#include <cstdlib>
#include <string>

namespace ddem::harness::test {

/// Whether python3 has numpy; Debian's comes first on the PATH from then on.
inline bool has_numpy() {
  static const bool has = [] {
    const char* path = std::getenv("PATH");
    ::setenv("PATH", ("/usr/bin:" + std::string(path == nullptr ? "" : path)).c_str(), 1);
    return std::system("python3 -c 'import numpy' >/dev/null 2>&1") == 0;
  }();
  return has;
}

}  // namespace ddem::harness::test

#define NEEDS_NUMPY() \
  if (!has_numpy()) GTEST_SKIP() << "python3 has no numpy (Debian: python3-numpy)"
