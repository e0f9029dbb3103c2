#pragma once
// Recordings whose times are uniform, or can be made so.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace ddem::harness {

struct UniformTimes {
  double t0 = 0.0, dt = 0.0;  ///< s
  std::size_t samples = 0;
  double widest_gap = 0.0;  ///< between neighbours of the times given; dt where they are uniform
  bool resampled = false;   ///< the values belong to other times than those given: see at_uniform_times()
};

/// Why times are not to be used, and the index of the first that is to blame.
struct TimesProblem {
  std::size_t index = 0;
  std::string what;
};

struct CheckedTimes {
  UniformTimes uniform;
  std::optional<TimesProblem> problem = std::nullopt;
};

/// Times that lie within a twentieth of a step of uniform ones are those (printed digits are cut). Others are taken at their median
/// distance instead, unless a gap is more than `kWidestGap` such distances wide. Fewer than two, or times that do not increase or
/// are not finite, are a problem.
inline constexpr double kWidestGap = 4.0;
CheckedTimes uniform_times(std::span<const double> times);

/// `values` at times t0 + n dt, by the cubic through the four samples around each.
std::vector<double> at_uniform_times(std::span<const double> times, std::span<const double> values, const UniformTimes& uniform);

}  // namespace ddem::harness
