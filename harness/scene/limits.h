#pragma once
// What scenes may ask for at most.

#include <cstdint>

namespace ddem::harness {

/// Of a run; days of the smallest packings.
inline constexpr std::int64_t kMostSteps = 2'000'000'000;

}  // namespace ddem::harness
