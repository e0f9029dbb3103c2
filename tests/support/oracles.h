#pragma once
// Results of other programs and exact solutions.

namespace ddem::test {

/// Their folder, tests/oracles.
extern const char* const kOracles;

}  // namespace ddem::test
