#pragma once
// A reader meets any bytes: it reads or refuses, and does nothing else.

#include <cstdlib>
#include <string_view>

#include "harness/io/errors.h"

/// Each fuzz_*.cc defines one.
void fuzz(std::string_view text);

/// libFuzzer reports what aborts.
inline void require(bool holds) {
  if (!holds) std::abort();
}

/// A refusal that says nothing is none.
template <class Read>
void refused_or_read(const Read& read) {
  try {
    read();
  } catch (const ddem::harness::InputError& e) {
    require(!e.messages().empty());
  }
}
