#pragma once
// Design curves: Poisson's ratio and E/k_n over k_t/k_n, for rigid and deformable discs and several
// coordinations, with the kinematic estimate. What one looks up before choosing an assembly.

#include <functional>
#include <string>
#include <vector>

#include "harness/calibrate/confidence.h"
#include "harness/calibrate/static_model.h"
#include "reports/figure.h"

namespace ddem::harness {

/// One point of a curve. Moduli at k_n = 1 N/m (contact modulus 1 Pa): E/k_n, 1/m for unit thickness.
struct CurvePoint {
  double stiffness_ratio = 0.0;
  MeanWithConfidence poisson, young;                      ///< static, over the seeds
  double kinematic_poisson = 0.0, kinematic_young = 0.0;  ///< mean over the seeds
};

struct DesignCurve {
  std::string model;  ///< "DEM", "DDEM F, k_n/E_p = 0.25, nu_p = 0.45"
  bool deformable = false;
  double softness = 0.0, particle_poisson_ratio = 0.0;
  double coordination = 0.0;  ///< as the scene asks for it, or bonds a disc, mean over the seeds
  std::vector<CurvePoint> points;
};

struct CurveOptions {
  int seeds = 6, threads = 1;
  double softness = 0.25, particle_poisson_ratio = 0.45;  ///< of the deformable discs
};

/// k_t/k_n = 0, 0.05 .. 0.3, 0.4 .. 1, the scene's variant of deformation (DDEM F where it has none) and
/// plain DEM; random packings whose coordination chooses the bonds also at 5.0, 5.4 and 6.0. What has no
/// equilibrium (sparse, k_t = 0) is left out. `on_progress` is told of each curve. Throws InputError.
std::vector<DesignCurve> design_curves(const Scene& scene, const CurveOptions& options,
                                       const std::function<void()>& on_progress);
std::size_t curve_count(const Scene& scene);

reports::Figure curve_figure(const std::vector<DesignCurve>& curves);

/// Header
/// model,coordination,softness,particle_poisson_ratio,stiffness_ratio,poisson_ratio,poisson_stddev,young_over_stiffness,
/// young_stddev,kinematic_poisson_ratio,kinematic_young_over_stiffness; softness and nu_p 0 for rigid discs.
std::string curve_csv(const std::vector<DesignCurve>& curves);

}  // namespace ddem::harness
