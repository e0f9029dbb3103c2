#pragma once
// Contact parameters for target moduli: `ddem calibrate`. The moduli are static ones of the real assembly,
// periodic or closed in y, and the mean over its seeds; Young's modulus by scale, Poisson's ratio by search.

#include <optional>
#include <string>
#include <vector>

#include "harness/calibrate/confidence.h"
#include "harness/calibrate/search.h"
#include "harness/calibrate/target.h"

namespace ddem::harness {

struct CalibrationOptions {
  SearchSpace space;
  int seeds = 6;  ///< of random packings, from the scene's own on
  int threads = 1;
  bool other_variants = true;  ///< ranges of variants that are neither DEM nor the scene's, which help where
                               ///< a target is out of reach
};

/// A way to deform the discs, or not to, and the Poisson's ratios that it reaches on this assembly.
struct VariantRange {
  std::string name;  ///< "DEM", "implicit F", ...
  ReachableRange
      poisson;  ///< k_t/k_n from 0 to 1, default softness and nu_p; DEM: mean over seeds, others: first seed
  bool own = false;  ///< the scene's variant, over what the options leave free
};

/// Parameters of the contacts and discs, and what the target's uncertainty makes of them: standard
/// deviations, the chosen parameters held.
struct FoundParameters {
  ModelPoint point;
  double stiffness = 0.0;                  ///< k_n, N/m, or the contact modulus, Pa
  double particle_young_modulus = 0.0;     ///< E_p, Pa; DDEM only
  std::optional<double> particle_density;  ///< kg/m3; where a bulk density is wanted
  std::optional<Parameter>
      solved_for;  ///< the one that answers to nu: an uncertain nu moves it and the stiffness
  double solved_stddev = 0.0, stiffness_stddev = 0.0;  ///< of the parameter itself, not of its logarithm; N/m
};

struct Stability {
  double radius = 0.0;          ///< spectral radius of K B, the largest of the fitted seeds
  std::optional<double> limit;  ///< of a lagged scheme
  std::string remark;           ///< what to beware of; empty: nothing
};

struct Calibration {
  Target target;
  bool feasible = false;
  std::string choice;     ///< how free parameters were chosen
  FoundParameters found;  ///< of the nearest reachable target where it is not feasible
  double young_modulus = 0.0, poisson_ratio = 0.0;  ///< that they give: means over the seeds
  MeanWithConfidence young_over_seeds, poisson_over_seeds;
  std::vector<std::int64_t> seeds;  ///< empty for packings without
  double solid_fraction = 0.0;
  std::vector<VariantRange> ranges;
  std::vector<std::string> what_helps;  ///< where it is not feasible
  std::optional<Stability> stability;   ///< DDEM
  std::vector<std::string> notes;       ///< what a user should know of the parameters found
  double seconds = 0.0;                 ///< without packings

  double young_residual() const { return young_modulus / target.young_modulus - 1.0; }
  double poisson_residual() const { return poisson_ratio - target.poisson_ratio; }
};

/// Throws InputError (scene), SolverError (no static equilibrium).
Calibration calibrate(const Scene& scene, const Target& target, const CalibrationOptions& options);

/// The scene with these parameters, and no load: for statics; `density` only where one was found.
Scene calibrated_scene(const Scene& scene, const FoundParameters& found);

}  // namespace ddem::harness
