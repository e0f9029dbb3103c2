#include "dem/simulation/conjugate_gradients.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ddem {
namespace {

// The number of iterations grows with the square root of k_n/E_p: 34 to 1e-10 at 5, about 150 at 100.
constexpr int kMostIterations = 2000;

/// In eight lanes, so that it vectorises; always the same bits.
double sum(const AlignedVector<double>& shares) {
  constexpr std::size_t kLanes = 8;
  double lane[kLanes] = {};
  for (std::size_t p = 0; p < shares.size(); p += kLanes) {
    for (std::size_t l = 0; l < kLanes; ++l) lane[l] += shares[p + l];
  }
  double total = 0.0;
  for (const double x : lane) total += x;
  return total;
}

}  // namespace

ConjugateGradients::ConjugateGradients(std::size_t places, const Compliance& compliance, double tolerance)
    : compliance_(compliance), tolerance_(tolerance) {
  for (auto* v : {&product_, &scale_}) v->assign(places, 0.0);
  for (auto* v : {&direction_, &applied_}) v->assign(kQuad * places, 0.0);
}

void ConjugateGradients::bind(StepData& d) {
  const double determinant = compliance_.direct * compliance_.direct - compliance_.coupling * compliance_.coupling;
  d.elasticity_direct = compliance_.direct / determinant;
  d.elasticity_coupling = -compliance_.coupling / determinant;
  d.elasticity_shear = 2.0 / compliance_.shear;
  d.product = product_.data(), d.scale = scale_.data();
  d.direction = direction_.data(), d.applied = applied_.data();
}

Stage ConjugateGradients::fail(StrainBreakdown::Cause cause) {
  const auto worst = std::max_element(product_.begin(), product_.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  breakdown_ = StrainBreakdown{cause, static_cast<int>(worst - product_.begin())};
  return Stage::motion;
}

Stage ConjugateGradients::start() {
  iterations_ = 0;
  square_ = sum(product_);
  target_ = tolerance_ * tolerance_ * sum(scale_);
  if (square_ < 0.0) return fail(StrainBreakdown::Cause::indefinite);
  // Not a number: the motion has broken down before, and whoever watches it says where.
  return square_ > target_ ? Stage::apply : Stage::motion;
}

Stage ConjugateGradients::after_advance(StepData& data) {
  const double before = std::exchange(square_, sum(product_));
  if (square_ <= target_) return Stage::motion;
  if (++iterations_ >= kMostIterations || !std::isfinite(square_)) return fail(StrainBreakdown::Cause::not_converged);
  data.direction_weight = square_ / before;
  return Stage::turn;
}

Stage ConjugateGradients::next(Stage finished, StepData& data) {
  switch (finished) {
    case Stage::residual: return start();
    case Stage::apply: {
      const double curvature = sum(product_);
      if (!(curvature > 0.0)) return fail(StrainBreakdown::Cause::indefinite);
      data.step_length = square_ / curvature;
      return Stage::advance;
    }
    case Stage::advance: return after_advance(data);
    case Stage::turn: return Stage::apply;
    default: break;
  }
  return Stage::motion;
}

}  // namespace ddem
