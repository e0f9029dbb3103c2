#include "harness/measure/local_line.h"

#include <algorithm>
#include <cmath>

namespace ddem::harness {
namespace {

double at(std::span<const double> values, std::ptrdiff_t n) {
  return values[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(n, 0, static_cast<std::ptrdiff_t>(values.size()) - 1))];
}

/// sum of k^2 for k = -half .. half
double sum_of_squares(std::ptrdiff_t half) {
  const auto h = static_cast<double>(half);
  return h * (h + 1.0) * (2.0 * h + 1.0) / 3.0;
}

std::vector<double> averaged(std::span<const double> values, std::ptrdiff_t half) {
  const auto size = static_cast<std::ptrdiff_t>(values.size());
  std::vector<double> out(values.size());
  double sum = 0.0;
  for (std::ptrdiff_t k = -half; k <= half; ++k) sum += at(values, k);
  for (std::ptrdiff_t n = 0; n < size; ++n) {
    out[static_cast<std::size_t>(n)] = sum / static_cast<double>(2 * half + 1);
    sum += at(values, n + half + 1) - at(values, n - half);
  }
  return out;
}

}  // namespace

LocalLine local_line(std::span<const double> values, std::ptrdiff_t middle, std::ptrdiff_t half) {
  double sum = 0.0, moment = 0.0;
  for (std::ptrdiff_t k = -half; k <= half; ++k) {
    const double value = at(values, middle + k);
    sum += value;
    moment += static_cast<double>(k) * value;
  }
  return {sum / static_cast<double>(2 * half + 1), moment / sum_of_squares(half)};
}

std::vector<double> value_weights(std::ptrdiff_t half) {
  return std::vector<double>(static_cast<std::size_t>(2 * half + 1), 1.0 / static_cast<double>(2 * half + 1));
}

std::vector<double> slope_weights(std::ptrdiff_t half) {
  std::vector<double> weights;
  for (std::ptrdiff_t k = -half; k <= half; ++k) weights.push_back(static_cast<double>(k) / sum_of_squares(half));
  return weights;
}

std::vector<double> smoothed(std::span<const double> values, std::size_t half) {
  if (half == 0 || values.empty()) return {values.begin(), values.end()};
  const auto h = static_cast<std::ptrdiff_t>(half);
  return averaged(averaged(values, h), h);
}

std::optional<Top> smooth_top(std::span<const double> values, double start, double reach, std::ptrdiff_t half) {
  const auto last = static_cast<std::ptrdiff_t>(values.size()) - 2;
  const auto from = std::max<std::ptrdiff_t>(1, static_cast<std::ptrdiff_t>(std::floor(start - reach)));
  const auto to = std::min(last, static_cast<std::ptrdiff_t>(std::ceil(start + reach)));
  std::optional<Top> nearest;
  for (std::ptrdiff_t n = from; n < to; ++n) {
    const double here = local_line(values, n, half).slope, next = local_line(values, n + 1, half).slope;
    if (!(here >= 0.0 && next < 0.0)) continue;
    const Top top{static_cast<double>(n) + here / (here - next), next - here};
    if (!nearest || std::abs(top.index - start) < std::abs(nearest->index - start)) nearest = top;
  }
  if (!nearest) return nearest;
  // One difference of neighbours is noise; over the half width it is that of the pulse.
  const auto middle = static_cast<std::ptrdiff_t>(std::lround(nearest->index));
  nearest->curvature =
      (local_line(values, middle + half, half).slope - local_line(values, middle - half, half).slope) / static_cast<double>(2 * half);
  return nearest->curvature < 0.0 ? nearest : std::nullopt;
}

std::optional<Foot> tangent_foot(std::span<const double> values, double top, double reach, std::ptrdiff_t half) {
  const auto last = static_cast<std::ptrdiff_t>(std::floor(top));
  const auto first = std::max<std::ptrdiff_t>(1, static_cast<std::ptrdiff_t>(std::floor(top - reach)));
  std::ptrdiff_t steepest = first;
  double slope = 0.0;
  for (std::ptrdiff_t n = first; n <= last; ++n) {
    const double here = local_line(values, n, half).slope;
    if (here > slope) slope = here, steepest = n;
  }
  if (!(slope > 0.0) || steepest == first || steepest == last) return std::nullopt;
  // The steepest place lies between samples: parabolas through three slopes and three values.
  const LocalLine before = local_line(values, steepest - 1, half), here = local_line(values, steepest, half),
                  after = local_line(values, steepest + 1, half);
  const double bend = before.slope - 2.0 * here.slope + after.slope;
  const double shift = bend < 0.0 ? std::clamp(0.5 * (before.slope - after.slope) / bend, -0.5, 0.5) : 0.0;
  const auto between = [shift](double left, double middle, double right) {
    return middle + 0.5 * (right - left) * shift + 0.5 * (left - 2.0 * middle + right) * shift * shift;
  };
  const double value = between(before.value, here.value, after.value), steepness = between(before.slope, here.slope, after.slope);
  return Foot{static_cast<double>(steepest) + shift - value / steepness, value, steepness};
}

}  // namespace ddem::harness
