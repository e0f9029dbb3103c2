#include "meshes/packings/grading.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace ddem::packings {
namespace {

constexpr double kDeviations = 2.0;  // of log-normal radii
// Mathematical libraries differ in the last bits of exp and erf, and packings must not: these radii are whole multiples of 1e-9.
constexpr double kRounded = 0x1p-30;

double normal_share(double deviations) { return 0.5 * std::erfc(-deviations / std::numbers::sqrt2); }

/// Where the normal distribution, cut off at two standard deviations, has this share below.
double cut_normal_quantile(double share) {
  const double least = normal_share(-kDeviations), wanted = least + share * (1.0 - 2.0 * least);
  double low = -kDeviations, high = kDeviations;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (normal_share(middle) < wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

void check(const SieveCurve& s) {
  const auto is_curve = [&] {
    if (s.radius.size() < 2 || s.passing.size() != s.radius.size() || !(s.radius.front() > 0.0)) return false;
    if (s.passing.front() != 0.0 || s.passing.back() != 1.0) return false;
    for (std::size_t k = 1; k < s.radius.size(); ++k) {
      if (!(s.radius[k] > s.radius[k - 1] && s.passing[k] >= s.passing[k - 1])) return false;
    }
    return std::isfinite(s.radius.back());
  };
  if (!is_curve()) throw std::invalid_argument("a sieve curve needs increasing radii, and shares that increase from 0 to 1");
}

/// Mass m(r) in a range of radii is of m(r) / r^2 discs: a segment of the curve has (p_k+1 - p_k) / (r_k r_k+1) of them, and of these the
/// share f is below r where 1/r = (1 - f) / r_k + f / r_k+1.
std::vector<double> sieved_radii(const SieveCurve& s, int discs) {
  check(s);
  std::vector<double> below{0.0};  // discs below radius k
  for (std::size_t k = 1; k < s.radius.size(); ++k)
    below.push_back(below.back() + (s.passing[k] - s.passing[k - 1]) / ((s.radius[k] / s.radius[0]) * (s.radius[k - 1] / s.radius[0])));
  std::vector<double> radii;
  std::size_t k = 1;
  for (int n = 0; n < discs; ++n) {
    const double wanted = below.back() * ((n + 0.5) / discs);
    while (below[k] < wanted) ++k;
    const double f = (wanted - below[k - 1]) / (below[k] - below[k - 1]);
    radii.push_back(1.0 / ((1.0 - f) * (s.radius[0] / s.radius[k - 1]) + f * (s.radius[0] / s.radius[k])));
  }
  return radii;
}

std::vector<double> log_normal_radii(double radius_ratio, int discs) {
  const double deviation = std::log(radius_ratio) / (2.0 * kDeviations);
  std::vector<double> radii;
  for (int n = 0; n < discs; ++n) {
    const double radius = std::exp(deviation * (kDeviations + cut_normal_quantile((n + 0.5) / discs)));
    radii.push_back(std::round(radius / kRounded) * kRounded);
  }
  return radii;
}

std::vector<double> uniform_radii(double radius_ratio, int discs) {
  std::vector<double> radii;
  for (int k = 0; k < discs; ++k) radii.push_back(1.0 + (radius_ratio - 1.0) * k / (discs - 1));
  return radii;
}

}  // namespace

std::vector<double> graded_radii(const Grading& grading, double radius_ratio, int discs) {
  switch (grading.law) {
    case Grading::Law::uniform: return uniform_radii(radius_ratio, discs);
    case Grading::Law::log_normal: return log_normal_radii(radius_ratio, discs);
    case Grading::Law::sieve: return sieved_radii(grading.sieve, discs);
  }
  throw std::invalid_argument("no such grading");
}

}  // namespace ddem::packings
