#include "harness/calibrate/search.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include "harness/calibrate/margin.h"
#include "harness/calibrate/newton.h"

namespace ddem::harness {
namespace {

// Round-off of the static solves is 1e-12 of nu; quadratic convergence passes from above this to there.
constexpr double kRootTolerance = 1e-11;

Interval interval_of(const SearchSpace& space, const StaticModel& model, const ModelPoint& at, Parameter p) {
  switch (p) {
    case Parameter::stiffness_ratio:
      return space.stiffness_ratio;
    case Parameter::log_softness:
      return {std::log(space.softness.low), std::log(softest(model, space, at))};
    case Parameter::particle_poisson_ratio:
      break;
  }
  return space.particle_poisson_ratio;
}

/// The line through a point along one parameter.
class Line {
 public:
  Line(const StaticModel& model, const SearchSpace& space, const ModelPoint& point, Parameter parameter,
       double target)
      : model_(model),
        point_(point),
        parameter_(parameter),
        target_(target),
        interval_(interval_of(space, model, point, parameter)) {}

  /// Where the line meets the target, or the end of it that comes closest.
  SearchResult nearest() {
    BracketedRoot low = end(interval_.low);
    if (interval_.fixed() || std::abs(low.value) <= kRootTolerance) return at(low.x);
    BracketedRoot high = end(first_high());
    while (same_side(low, high) && high.x < interval_.high) {
      if (std::abs(high.value) > std::abs(low.value)) break;  // away from the target
      low = high;
      high = end(std::min(10.0 * high.x, interval_.high));
    }
    if (same_side(low, high)) return at(std::abs(low.value) < std::abs(high.value) ? low.x : high.x);
    return at(bracketed_newton([this](double x) { return with_slope(x); }, low, high, kRootTolerance).x);
  }

  /// The same from the point itself, which is close to the target: plain Newton; none where that leaves the
  /// interval.
  std::optional<SearchResult> nearby() {
    constexpr int kMost = 8;
    double x = point_.get(parameter_);
    for (int n = 0; n < kMost; ++n) {
      if (!(x > interval_.low && x < interval_.high)) return std::nullopt;
      const ValueAndSlope v = with_slope(x);
      if (std::abs(v.value) <= kRootTolerance) return at(x);
      x -= v.value / v.slope;
    }
    return std::nullopt;
  }

 private:
  static bool same_side(const BracketedRoot& a, const BracketedRoot& b) {
    return (a.value < 0.0) == (b.value < 0.0);
  }
  ModelPoint point_at(double x) const {
    ModelPoint p = point_;
    p.set(parameter_, x);
    return p;
  }
  /// Of a place that was evaluated.
  SearchResult at(double x) const {
    const MeanModuli& m = evaluated_.at(x);
    return {point_at(x), m, m.poisson - target_, {}};
  }
  BracketedRoot end(double x) { return {x, (evaluated_[x] = model_.at(point_at(x))).poisson - target_}; }
  ValueAndSlope with_slope(double x) {
    const Parameter rates[] = {parameter_};
    const MeanModuli& m = evaluated_[x] = model_.at(point_at(x), rates);
    return {m.poisson - target_, m.poisson_rates[0]};
  }
  /// k_t/k_n has no end of its own: beyond 1 only where the target asks for it.
  double first_high() const {
    const bool open = parameter_ == Parameter::stiffness_ratio && interval_.low < 1.0;
    return open ? std::min(1.0, interval_.high) : interval_.high;
  }

  const StaticModel& model_;
  ModelPoint point_;
  Parameter parameter_;
  double target_;
  Interval interval_;
  std::map<double, MeanModuli> evaluated_;
};

/// From a point close to the target, by the first of its parameters that has room to move.
std::optional<SearchResult> onto_target(const StaticModel& model, const SearchSpace& space,
                                        const ModelPoint& point, double target) {
  for (const Parameter p :
       {Parameter::stiffness_ratio, Parameter::log_softness, Parameter::particle_poisson_ratio}) {
    if (p != Parameter::stiffness_ratio && !model.deformable()) break;
    if (auto moved = Line(model, space, point, p, target).nearby()) return moved;
  }
  return std::nullopt;
}

class Search {
 public:
  Search(const StaticModel& model, const SearchSpace& space, double target)
      : model_(model), space_(space), target_(target) {}

  SearchResult run() {
    if (!model_.deformable()) {
      return along(Parameter::stiffness_ratio, {},
                   space_.stiffness_ratio.fixed() ? "k_t/k_n as given" : "k_t/k_n is the only unknown");
    }
    SearchResult first = stiffest();
    if (!first.feasible()) return first;
    const bool choice =
        space_.free_parameters() > 1 && (space_.preference == Preference::margin || !needs_softness_);
    return choice ? with_margin(first) : first;
  }

 private:
  SearchResult along(Parameter p, const ModelPoint& from, std::string choice) const {
    SearchResult r = Line(model_, space_, from, p, target_).nearest();
    r.choice = std::move(choice);
    return r;
  }

  static const SearchResult& nearer(const SearchResult& a, const SearchResult& b) {
    return std::abs(b.residual) < std::abs(a.residual) ? b : a;
  }

  /// With the stiffest discs that reach the target: at the lower end of the softness by k_t/k_n and nu_p, or
  /// else in the corner of these two that reaches furthest, by the softness.
  SearchResult stiffest() {
    const Interval nu_p = space_.particle_poisson_ratio;
    ModelPoint start{space_.stiffness_ratio.low, space_.softness.low,
                     std::clamp(target_, nu_p.low, nu_p.high)};
    const auto by_free = [&] {
      return space_.stiffness_ratio.fixed()
                 ? along(Parameter::particle_poisson_ratio, start,
                         "k_t/k_n as given, stiffest discs; nu_p solves for nu")
                 : along(Parameter::stiffness_ratio, start, "stiffest discs; k_t/k_n solves for nu");
    };
    SearchResult best = by_free();
    const bool too_low = best.residual < 0.0;
    if (!best.feasible() && !space_.stiffness_ratio.fixed() && !nu_p.fixed()) {
      start.particle_poisson_ratio = too_low ? nu_p.high : nu_p.low;
      best = nearer(best, by_free());
    }
    if (best.feasible() || space_.softness.fixed()) return best;
    needs_softness_ = true;
    const ModelPoint corner{too_low ? space_.stiffness_ratio.low : space_.stiffness_ratio.high,
                            space_.softness.low, too_low ? nu_p.high : nu_p.low};
    return nearer(best,
                  along(Parameter::log_softness, corner,
                        "the stiffest discs that reach nu, with k_t/k_n and nu_p where they help most"));
  }

  /// Moved along nu = target to the largest margin (first seed), then onto the target again over all seeds.
  SearchResult with_margin(const SearchResult& first) const {
    SearchSpace space = space_;
    if (space.preference == Preference::stiffest) space.softness.high = space.softness.low;
    const ModelPoint wanted = largest_margin(model_.first_seed(), space, first.point);
    if (wanted == first.point) return first;
    auto moved = onto_target(model_, space_, wanted, target_);
    if (!moved) return first;
    moved->choice = space_.preference == Preference::margin
                        ? "largest stability margin (smallest spectral radius of K B) of all that meet nu"
                        : "stiffest discs; k_t/k_n and nu_p with the largest stability margin (smallest "
                          "spectral radius of K B)";
    return *moved;
  }

  const StaticModel& model_;
  const SearchSpace& space_;
  double target_;
  bool needs_softness_ = false;
};

}  // namespace

bool SearchResult::feasible() const {
  return std::abs(residual) <= kPoissonTolerance;
}

double softest(const StaticModel& model, const SearchSpace& space, const ModelPoint& point) {
  const auto limit = model.radius_limit();
  if (!limit || space.softness.fixed()) return space.softness.high;
  return std::clamp(*limit / model.radius_per_softness(point), space.softness.low, space.softness.high);
}

SearchResult find_poisson(const StaticModel& model, const SearchSpace& space, double target) {
  if (model.assemblies().size() > 1) {
    const SearchResult of_first = Search(model.first_seed(), space, target).run();
    auto of_all = of_first.feasible() ? onto_target(model, space, of_first.point, target) : std::nullopt;
    if (of_all) {
      of_all->choice = of_first.choice;
      return *of_all;
    }
  }
  return Search(model, space, target).run();
}

ReachableRange reachable_range(const StaticModel& model, const SearchSpace& space,
                               const std::optional<ReachableRange>& rigid) {
  ReachableRange range = rigid.value_or(ReachableRange{HUGE_VAL, -HUGE_VAL});
  const double most = std::max(space.stiffness_ratio.low, std::min(1.0, space.stiffness_ratio.high));
  for (const bool high : {false, true}) {
    ModelPoint corner{high ? space.stiffness_ratio.low : most, space.softness.low,
                      high ? space.particle_poisson_ratio.high : space.particle_poisson_ratio.low};
    const auto add = [&] {
      const double nu = model.at(corner).poisson;
      range.lowest = std::min(range.lowest, nu);
      range.highest = std::max(range.highest, nu);
    };
    if (!rigid) add();
    if (!model.deformable() || space.softness.fixed()) continue;
    corner.softness = softest(model, space, corner);
    add();
  }
  return range;
}

}  // namespace ddem::harness
