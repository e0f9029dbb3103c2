#pragma once
// Where each scheme is stable: growth a step, predicted and measured, over the time step and the softness of the discs.
//
// Predicted: on a periodic piece of the lattice from its plane waves (bloch.h), in a small random packing from the
// eigenvalues of the step itself (step_map.h); of all motions but rigid ones that which grows fastest or decays slowest.
// Motions that strain no disc, which some waves of the lattice are, neither grow nor decay, and are left out while there are
// others.
// Measured: a run is started from that motion (at rest in its strains, which the scheme then finds), and its growth taken
// from the recording by linear prediction. A second run starts from noise, which holds all motions: it must blow up, or
// must not.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/solvers/solver.h"
#include "harness/studies/strip/strip_campaign.h"

namespace ddem::harness {

/// One map: everything but the step and the softness of the discs.
struct StabilityKey {
  StripPacking packing = StripPacking::hexagonal;
  Scheme scheme = Scheme::none;
  Correction correction = Correction::full;  ///< not for Scheme::none
  double stiffness_ratio = 0.0;              ///< k_t/k_n
  double particle_poisson_ratio = 0.3;       ///< nu_p
};

std::string name(const StabilityKey& key);  ///< "lagged N, k_t/k_n = 0.3, nu_p = 0.3"
std::string slug(const StabilityKey& key);  ///< "hexagonal/lagged-normal/kt0.30/nu0.30"

struct StabilityGrid {
  std::vector<StabilityKey> maps;
  std::vector<double> softness;       ///< k_n/E_p, ascending
  std::vector<double> step_fraction;  ///< of the critical step of rigid discs, ascending
  std::vector<double> random_softness, random_step_fraction;  ///< of random packings
  int random_discs = 16;
  const Solver* solver = &builtin_solver();
  /// Changes what the runs are given, not the predictions: a defect that the comparison must find.
  std::function<void(SimulationInput&)> disturb;
};

DDEM_MEMBERS(StabilityKey, packing, scheme, correction, stiffness_ratio, particle_poisson_ratio)

/// `full`: every scheme and correction over k_t/k_n and nu_p, k_n/E_p 0.01 .. 10, steps 0.02 .. 1.1, larger random packings:
/// many minutes. Otherwise some seconds.
StabilityGrid stability_grid(bool full);

struct StabilityPoint {
  double softness = 0.0, step_fraction = 0.0;
  double predicted = 0.0;               ///< |z| - 1 of a step
  std::optional<double> measured;       ///< empty: the run was too short to tell, or had no finite sample
  bool noise_grew = false;              ///< the run from noise blew up
  /// What must happen to noise, where the prediction is decisive: above this growth it must blow up, below none it must not.
  std::optional<bool> noise_should_grow;
  /// Strains alone grow (or faster than any motion), uniform over the piece, so that they move no disc: unstable, and not
  /// to be measured; no comparison. Only close to the limit of softness.
  bool unseen = false;

  double disagreement() const;  ///< |measured - predicted| over |predicted|, or over kGrowthFloor where that is more
  bool wrong_side() const;      ///< growth and decay confused, beyond kGrowthFloor; or noise did what it should not
};

/// Growth (or decay) that counts as none. Implicit strains are right to 1e-6 of the stiffness, so that a run holds as much of
/// other motions than the one it was released from; over the hundred steps that are read, that looks like growth of 1e-8 to
/// 1e-7 a step: 2 % of this.
inline constexpr double kGrowthFloor = 5e-6;

struct StabilityMap {
  StabilityKey key;
  std::string failure;                ///< empty: ok
  std::vector<double> softness, step_fraction;
  std::vector<StabilityPoint> points;  ///< by rows of equal step_fraction
  /// Largest stable step (fraction; 0: none) predicted, over the softness; empty where there is no sharp one.
  std::vector<double> boundary_softness, boundary_fraction;

  double worst_disagreement() const;  ///< infinite where nothing was measured at a point
  int wrong_sides() const;
};

DDEM_MEMBERS(StabilityPoint, softness, step_fraction, predicted, measured, noise_grew, noise_should_grow, unseen)
DDEM_MEMBERS(StabilityMap, key, failure, softness, step_fraction, points, boundary_softness, boundary_fraction)

StabilityMap map_stability(const StripCampaign& campaign, const StabilityGrid& grid, const StabilityKey& key);

}  // namespace ddem::harness
