#pragma once
// Contact parameters for a Poisson's ratio. k_n follows from Young's modulus by scale, so that one equation
// is left, nu(k_t/k_n, k_n/E_p, nu_p) = target, in one unknown (DEM) or up to three (DDEM). In each of them
// nu is monotonic: it falls with k_t/k_n, rises with nu_p, and moves towards nu_p with the softness.

#include <optional>
#include <string>

#include "harness/calibrate/static_model.h"

namespace ddem::harness {

struct Interval {
  double low = 0.0, high = 0.0;
  bool fixed() const { return low == high; }
};

/// Where parameters outnumber targets.
enum class Preference {
  stiffest,  ///< the smallest k_n/E_p; among those the largest stability margin
  margin     ///< the largest stability margin, i.e. the smallest spectral radius of K B
};

/// What may be searched; a single value is held.
struct SearchSpace {
  Interval stiffness_ratio{0.0, 1e6};
  Interval softness{0.01, 10.0};  ///< of lagged discs: at most as far as they are stable
  Interval particle_poisson_ratio{0.0, 0.49};
  Preference preference = Preference::stiffest;

  /// Of deformable discs.
  int free_parameters() const { return int(!stiffness_ratio.fixed()) + int(!softness.fixed()) + int(!particle_poisson_ratio.fixed()); }
};

struct SearchResult {
  ModelPoint point;       ///< that meets the target, or the nearest one
  MeanModuli moduli;      ///< there, over all seeds
  double residual = 0.0;  ///< nu - target
  std::string choice;     ///< how free parameters were chosen, in words

  /// The verdict: what the static solve says of the point, not whether a search ended well.
  bool feasible() const;
};

/// Of nu, within which a target is met.
inline constexpr double kPoissonTolerance = 1e-6;

/// Searched on the first seed, then moved onto the target over all seeds; searched over all of them where
/// that fails. Throws std::runtime_error where the assembly has no static equilibrium.
SearchResult find_poisson(const StaticModel& model, const SearchSpace& space, double target);

/// Values of nu that the space offers for k_t/k_n up to 1 (above, nu falls on, for rigid discs towards -1).
struct ReachableRange {
  double lowest = 0.0, highest = 0.0;
};
/// `rigid`: what is known of the stiff end, where it need not be computed.
ReachableRange reachable_range(const StaticModel& model, const SearchSpace& space,
                               const std::optional<ReachableRange>& rigid = {});

/// Softness up to which a point is stable, or the space's own end.
double softest(const StaticModel& model, const SearchSpace& space, const ModelPoint& point);

}  // namespace ddem::harness
