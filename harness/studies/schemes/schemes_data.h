#pragma once
// Which scheme to choose: rigid discs, lagged and implicit strains side by side, each with its own errors. The discs are
// those of the campaign; energy on its first random strip, the rest on the lattice, where the answers are known.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dem/core/material.h"
#include "harness/solvers/solver.h"
#include "harness/studies/strip/strip_campaign.h"

namespace ddem::harness {

/// A scheme of the study.
struct StudiedScheme {
  std::string name;
  DeformationParameters deformation;
};

/// The energy of a free strip that starts from rest with u_x = A cos(pi x / L), over that of step 200.
struct EnergyCurve {
  std::string scheme;
  double step_fraction = 0.0;
  std::vector<double> time, energy;
  std::optional<double> drift;  ///< largest |energy / first - 1|; empty: the run broke down
  double nanoseconds_per_bond_step = 0.0;
};

/// Poisson's ratio from P and shear velocities in the lattice, k_t = 0, against k_n/E_p.
struct ReachPoint {
  double softness = 0.0;       ///< k_n/(E_p h)
  std::optional<double> poisson;  ///< empty: unstable, or no speed
  double closed_form = 0.0;
};
struct ReachCurve {
  std::string scheme;
  std::vector<ReachPoint> points;
};

/// A plane shear wave in the lattice, k_t = 0, after two periods: largest error of its displacement over its amplitude,
/// against the exact cosine.
struct OrderCurve {
  std::string scheme;
  std::vector<double> step_fraction, error;
  double order = 0.0;  ///< slope of the last two points
};

struct SchemeStudy {
  std::string failure;  ///< empty: ok
  double reach_poisson_ratio = 0.0;  ///< nu_p of the reach curves
  std::vector<EnergyCurve> energy;
  std::vector<ReachCurve> reach;
  std::vector<OrderCurve> order;
};

DDEM_MEMBERS(EnergyCurve, scheme, step_fraction, time, energy, drift, nanoseconds_per_bond_step)
DDEM_MEMBERS(ReachPoint, softness, poisson, closed_form)
DDEM_MEMBERS(ReachCurve, scheme, points)
DDEM_MEMBERS(OrderCurve, scheme, step_fraction, error, order)
DDEM_MEMBERS(SchemeStudy, failure, reach_poisson_ratio, energy, reach, order)

/// Throws std::runtime_error where members that belong together do not fit: a result of another program.
void require_whole(const SchemeStudy& found);

/// Deterministic but for the times. `on_progress` is called kSchemeStudySteps times.
inline constexpr std::size_t kSchemeStudySteps = 3;
SchemeStudy study_schemes(const StripCampaign& campaign, const std::function<void()>& on_progress, const Solver& solver = builtin_solver());

}  // namespace ddem::harness
