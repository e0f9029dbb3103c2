#include "harness/calibrate/margin.h"

#include <algorithm>
#include <cmath>
#include <nlopt.hpp>
#include <vector>

namespace ddem::harness {
namespace {

constexpr int kMostEvaluations = 15;  // the radius is flat, and has kinks where two eigenvalues cross
constexpr double kDifference = 1e-4;  // of the radius: Lanczos is right to 1e-10 of it
constexpr double kSmallestRatio = 1e-3;  // of k_t/k_n: at 0 its derivative does not exist

/// ln(radius) and nu as functions of the free parameters.
struct Problem {
  const StaticModel& model;
  ModelPoint point;
  std::vector<Parameter> free;
  double target = 0.0;

  ModelPoint at(const std::vector<double>& x) const {
    ModelPoint p = point;
    for (std::size_t k = 0; k < free.size(); ++k) p.set(free[k], x[k]);
    return p;
  }
  double log_radius(const ModelPoint& p) const { return std::log(p.softness * model.radius_per_softness(p)); }

  /// The radius is proportional to the softness; by the others, forward differences.
  static double objective(const std::vector<double>& x, std::vector<double>& gradient, void* data) {
    const auto& problem = *static_cast<const Problem*>(data);
    std::vector<ModelPoint> points = {problem.at(x)};
    for (std::size_t k = 0; k < gradient.size(); ++k) {
      if (problem.free[k] == Parameter::log_softness) continue;
      points.push_back(points.front());
      points.back().set(problem.free[k], x[k] + kDifference);
    }
    const std::vector<double> radii = problem.model.radii_per_softness(points);
    const double log_radius = std::log(radii.front());
    for (std::size_t k = 0, next = 1; k < gradient.size(); ++k) {
      gradient[k] = problem.free[k] == Parameter::log_softness
                        ? 1.0
                        : (std::log(radii[next++]) - log_radius) / kDifference;
    }
    return log_radius + std::log(points.front().softness);
  }

  static double deviation(const std::vector<double>& x, std::vector<double>& gradient, void* data) {
    const auto& problem = *static_cast<const Problem*>(data);
    const MeanModuli m = problem.model.at(problem.at(x), problem.free);
    std::copy(m.poisson_rates.begin(), m.poisson_rates.begin() + static_cast<std::ptrdiff_t>(gradient.size()),
              gradient.begin());
    return m.poisson - problem.target;
  }
};

}  // namespace

ModelPoint largest_margin(const StaticModel& model, const SearchSpace& space, const ModelPoint& start) {
  Problem problem{model, start, {}, model.at(start).poisson};
  std::vector<double> low, high, x;
  const auto add = [&](Parameter p, const Interval& interval) {
    if (interval.fixed()) return;
    problem.free.push_back(p);
    low.push_back(interval.low);
    high.push_back(interval.high);
    x.push_back(std::clamp(start.get(p), interval.low, interval.high));
  };
  const Interval ratio = space.stiffness_ratio;
  if (!ratio.fixed())
    add(Parameter::stiffness_ratio,
        {std::max(ratio.low, kSmallestRatio), std::min(ratio.high, std::max(1.0, start.stiffness_ratio))});
  if (!space.softness.fixed())
    add(Parameter::log_softness, {std::log(space.softness.low), std::log(space.softness.high)});
  const Interval nu_p = space.particle_poisson_ratio;
  if (!nu_p.fixed()) add(Parameter::particle_poisson_ratio, {nu_p.low, nu_p.high - kDifference});
  if (problem.free.size() < 2) return start;
  nlopt::opt search(nlopt::LD_SLSQP, static_cast<unsigned>(problem.free.size()));
  search.set_lower_bounds(low);
  search.set_upper_bounds(high);
  search.set_min_objective(&Problem::objective, &problem);
  search.add_equality_constraint(&Problem::deviation, &problem, 1e-6);
  search.set_maxeval(kMostEvaluations);
  search.set_xtol_rel(1e-4);
  double value = 0.0;
  try {
    search.optimize(x, value);
  } catch (const nlopt::roundoff_limited&) {  // x is the best so far
  } catch (const std::runtime_error&) {
    return start;
  }
  const ModelPoint found = problem.at(x);
  const bool met = std::abs(model.at(found).poisson - problem.target) < 1e-3;
  return met && problem.log_radius(found) < problem.log_radius(start) ? found : start;
}

}  // namespace ddem::harness
