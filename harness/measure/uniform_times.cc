#include "harness/measure/uniform_times.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ddem::harness {
namespace {

constexpr double kRounding = 0.05;  // of a step

/// The value at t of the cubic through four points (Lagrange's).
double cubic(std::span<const double> times, std::span<const double> values, double t) {
  double sum = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    double factor = values[i];
    for (std::size_t j = 0; j < times.size(); ++j) {
      if (j != i) factor *= (t - times[j]) / (times[i] - times[j]);
    }
    sum += factor;
  }
  return sum;
}

}  // namespace

CheckedTimes uniform_times(std::span<const double> times) {
  if (times.size() < 2) return {{}, TimesProblem{0, "fewer than two samples"}};
  std::vector<double> gaps;
  for (std::size_t n = 0; n < times.size(); ++n) {
    if (!std::isfinite(times[n])) return {{}, TimesProblem{n, "the time is not finite"}};
    if (n > 0 && !(times[n] > times[n - 1])) return {{}, TimesProblem{n, "the time does not increase"}};
    if (n > 0) gaps.push_back(times[n] - times[n - 1]);
  }
  const double mean = (times.back() - times.front()) / static_cast<double>(gaps.size());
  bool uniform = true;
  for (std::size_t n = 0; n < times.size(); ++n)
    uniform = uniform && std::abs(times[n] - times.front() - static_cast<double>(n) * mean) <= kRounding * mean;
  if (uniform) return {{times.front(), mean, times.size(), mean, false}};

  const auto widest = std::max_element(gaps.begin(), gaps.end());
  const double gap = *widest;
  const auto index = static_cast<std::size_t>(widest - gaps.begin()) + 1;
  const auto middle = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2);
  std::nth_element(gaps.begin(), middle, gaps.end());
  const double median = *middle;
  if (gap > kWidestGap * median)
    return {{}, TimesProblem{index, fmt::format("a gap of {:.4g} s, where most samples are {:.4g} s apart", gap, median)}};
  const auto samples = static_cast<std::size_t>((times.back() - times.front()) / median * (1.0 + 1e-12)) + 1;
  return {{times.front(), median, samples, gap, true}};
}

std::vector<double> at_uniform_times(std::span<const double> times, std::span<const double> values, const UniformTimes& uniform) {
  if (times.size() != values.size() || times.size() < 2)
    throw std::invalid_argument("a signal needs as many values as times, two at least");
  const std::size_t points = std::min<std::size_t>(4, times.size());
  std::vector<double> out;
  std::size_t before = 0;  // times[before] <= t, but at the very end
  for (std::size_t n = 0; n < uniform.samples; ++n) {
    const double t = uniform.t0 + static_cast<double>(n) * uniform.dt;
    while (before + 2 < times.size() && times[before + 1] <= t) ++before;
    const std::size_t first = std::min(before > 0 ? before - 1 : 0, times.size() - points);
    out.push_back(cubic(times.subspan(first, points), values.subspan(first, points), t));
  }
  return out;
}

}  // namespace ddem::harness
