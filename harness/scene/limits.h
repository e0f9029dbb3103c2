#pragma once
// What scenes may ask for at most.

#include <cstdint>

namespace ddem::harness {

/// Of a run; days of the smallest packings.
inline constexpr std::int64_t kMostSteps = 2'000'000'000;

/// Random discs up to so many are jammed as a whole without being asked.
inline constexpr std::int64_t kJammedUnasked = 20000;

}  // namespace ddem::harness
