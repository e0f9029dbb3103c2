#pragma once
// Static moduli of an assembly, mean over seeds, as functions of the parameters of contacts and discs: what a
// calibration inverts. At unit stiffness: with k_n/E_p fixed, all moduli scale with k_n.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "dem/assembly/assembly.h"
#include "dem/statics/operator_rates.h"
#include "harness/scene/scene.h"

namespace ddem::harness {

/// Everything but the scale.
struct ModelPoint {
  double stiffness_ratio = 0.0;  ///< k_t/k_n
  double softness =
      0.0;  ///< k_n/(E_p h); DDEM only. With a contact modulus k_n is the mean over the first seed's bonds
  double particle_poisson_ratio = 0.0;  ///< nu_p; DDEM only

  double get(Parameter parameter) const;  ///< the logarithm of the softness
  void set(Parameter parameter, double value);
  bool operator==(const ModelPoint&) const = default;
};

struct SeedModuli {
  double young = 0.0, poisson = 0.0;  ///< Pa at k_n = 1 N/m (contact modulus 1 Pa)
};

struct MeanModuli {
  double young = 0.0, poisson = 0.0;  ///< means over the seeds
  std::vector<SeedModuli> seeds;
  std::vector<double> young_rates, poisson_rates;  ///< by the parameters asked for
};

/// What is homogenised: the scene's cell, or its packing closed in y, for each seed. Only random packings
/// have seeds.
struct SeedAssembly {
  std::int64_t seed = 0;
  ddem::Assembly assembly;
  double edge_band = 0.0;  ///< m
};

/// Seeds from the scene's own on; one assembly for packings without seeds. Throws InputError, also for a
/// packing from a file that cannot be closed in y.
std::vector<SeedAssembly> seed_assemblies(const Scene& scene, std::int64_t first, int count, int threads);

/// The scene of another seed.
Scene with_seed(const Scene& scene, std::int64_t seed);
/// Of a random packing; none for others.
std::optional<std::int64_t> seed_of(const Scene& scene);

class StaticModel {
 public:
  /// Kind of contact and variant of the deformation come from the scene; its stiffnesses and the discs'
  /// constants do not matter.
  StaticModel(const Scene& scene, std::vector<SeedAssembly> assemblies, int threads);

  /// The same assemblies with another variant.
  StaticModel variant(const DeformationParameters& deformation) const;
  /// The first seed alone.
  StaticModel first_seed() const;

  bool deformable() const { return deformation_.active(); }
  const DeformationParameters& deformation() const { return deformation_; }
  const std::vector<SeedAssembly>& assemblies() const { return *assemblies_; }

  /// Threads share the seeds; the same bits for any number. Throws std::runtime_error where an assembly has a
  /// mechanism.
  MeanModuli at(const ModelPoint& point, std::span<const Parameter> rates = {}) const;

  /// Spectral radius of K B over k_n/E_p, to which it is proportional: the largest of the seeds. DDEM only.
  double radius_per_softness(const ModelPoint& point) const {
    return radii_per_softness({&point, 1}).front();
  }
  /// The same of several points, shared by the threads.
  std::vector<double> radii_per_softness(std::span<const ModelPoint> points) const;
  /// 2/w - 1 of the lagged scheme; none where any softness is stable.
  std::optional<double> radius_limit() const;

  /// Contacts and discs of a point whose k_n (contact modulus) is `stiffness`.
  ContactParameters contact(const ModelPoint& point, double stiffness) const;
  DeformationParameters discs(const ModelPoint& point, double stiffness) const;

  double mean_solid_fraction() const;
  int threads() const { return threads_; }

 private:
  std::shared_ptr<const std::vector<SeedAssembly>> assemblies_;
  bool by_modulus_ = false;
  double mean_stiffness_ = 1.0;  ///< mean k_n of the first seed's bonds at unit stiffness, N/m
  DeformationParameters deformation_;
  std::size_t seeds_ = 0;
  int threads_ = 1;
};

}  // namespace ddem::harness
