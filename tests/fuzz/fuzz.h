#pragma once
// A reader meets any bytes: it reads or refuses, and does nothing else.

#include <cstdlib>
#include <string_view>

/// Each fuzz_*.cc defines one.
void fuzz(std::string_view text);

/// libFuzzer reports what aborts.
inline void require(bool holds) {
  if (!holds) std::abort();
}
