#pragma once
// Stability of a scene, without waiting for it to blow up: `ddem stability`.

#include <optional>
#include <string>
#include <vector>

#include "dem/spectra/flutter.h"
#include "dem/spectra/spectra.h"
#include "harness/run/noise_run.h"
#include "harness/run/wave_growth.h"
#include "harness/scene/scene.h"

namespace ddem::harness {

/// The infinite lattice of the scene's discs, all wave vectors.
struct LatticeStability {
  WorstWave worst;                            ///< at the scene's step
  std::optional<double> largest_stable_step;  ///< s
};

enum class StabilityVerdict { stable, unstable, undecided };

struct SceneStability {
  int discs = 0, bonds = 0;
  DeformationParameters deformation;
  double stiffness_ratio = 0.0;
  double time_step = 0.0, dem_critical_step = 0.0;
  CriticalStep critical;
  double softness = 0.0;                      ///< k_n/(E_p h), where there are deformable discs
  std::optional<double> fixed_point_radius;   ///< rho(KB), likewise
  double radius_limit = 0.0;                  ///< lagged: 2/w - 1
  std::optional<double> softness_limit;       ///< lagged: of k_n/(E_p h), at vanishing steps
  std::optional<SoftnessFactor> softness_limit_at_step;  ///< likewise, between two bounds
  std::optional<FlutterSearch> flutter;       ///< N with shear stiffness; not for lattices nor above 5000 discs
  std::optional<NoiseFlutter> noise_flutter;  ///< likewise above 5000 discs
  std::optional<double> step_growth;          ///< largest |z| - 1 of the very step, where small enough and nothing else decides
  std::optional<NoiseRun> noise;              ///< where it is too large
  std::optional<LatticeStability> lattice;    ///< hexagonal packings
  bool whole_lattice = false;                 ///< no edges: the waves of the lattice are all there are
  double slowest_growth = 0.0;                ///< a step: slower growth does not matter to the scene
  std::vector<WaveGrowth> waves;
  std::string no_waves;                       ///< why there are none

  bool has_energy() const;  ///< every correction but N with shear stiffness
  /// The critical step of the scheme says whether this one is stable; else motions may grow slowly that it does not know of.
  bool critical_step_decides() const;
  /// Why the scene is unstable at its step.
  std::vector<std::string> instabilities() const;
  StabilityVerdict verdict() const;
  /// Of a run that would show growth as slow as slowest_growth, where noise in fewer showed none.
  double steps_needed() const;
};

/// `wavelengths` in m; none: the length of the packing, and its half, quarter and eighth.
/// Throws InputError (scene), SolverError (an eigenvalue iteration failed).
SceneStability scene_stability(const Scene& scene, std::vector<double> wavelengths);

}  // namespace ddem::harness
