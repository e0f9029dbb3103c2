#include "harness/calibrate/static_model.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "dem/assembly/bond_stiffness.h"
#include "dem/spectra/spectra.h"
#include "dem/statics/moduli.h"
#include "harness/nightly/worker_pool.h"
#include "harness/io/errors.h"
#include "harness/model/assemble.h"
#include "harness/scene/place.h"

namespace ddem::harness {
namespace {

/// E = 4KG/(K+G), nu = (K-G)/(K+G), and what changes of K and G change in them.
struct YoungPoisson {
  double young, poisson;
};

YoungPoisson rate_of(const IsotropicModuli& m, const IsotropicModuli& rate) {
  const double k = m.bulk, g = m.shear, square = (k + g) * (k + g);
  return {4.0 * (g * g * rate.bulk + k * k * rate.shear) / square,
          2.0 * (g * rate.bulk - k * rate.shear) / square};
}

ddem::Assembly homogenisable(const Scene& scene) {
  if (scene.assembly.periodic.x) return build_network(scene);
  auto closed = build_laterally_closed(scene);
  if (!closed.assembly) {
    throw InputError(scene_problem(scene, "assembly.packing", "a packing that does not close in y has no bulk moduli to calibrate", closed.missing));
  }
  require_one_network(*closed.assembly);
  return std::move(*closed.assembly);
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

double ModelPoint::get(Parameter parameter) const {
  switch (parameter) {
    case Parameter::stiffness_ratio:
      return stiffness_ratio;
    case Parameter::log_softness:
      return std::log(softness);
    case Parameter::particle_poisson_ratio:
      break;
  }
  return particle_poisson_ratio;
}

void ModelPoint::set(Parameter parameter, double value) {
  switch (parameter) {
    case Parameter::stiffness_ratio:
      stiffness_ratio = value;
      return;
    case Parameter::log_softness:
      softness = std::exp(value);
      return;
    case Parameter::particle_poisson_ratio:
      particle_poisson_ratio = value;
      return;
  }
}

std::optional<std::int64_t> seed_of(const Scene& scene) {
  const auto* random = std::get_if<RandomPacking>(&scene.assembly.packing);
  return random != nullptr ? std::optional(random->seed) : std::nullopt;
}

Scene with_seed(const Scene& scene, std::int64_t seed) {
  Scene other = scene;
  if (auto* random = std::get_if<RandomPacking>(&other.assembly.packing)) random->seed = seed;
  return other;
}

std::vector<SeedAssembly> seed_assemblies(const Scene& scene, std::int64_t first, int count, int threads) {
  std::vector<SeedAssembly> out(seed_of(scene) ? static_cast<std::size_t>(count) : 1);
  run_jobs(out.size(), threads, [&](std::size_t k) {
    out[k].seed = first + static_cast<std::int64_t>(k);
    const Scene one = with_seed(scene, out[k].seed);
    out[k].assembly = homogenisable(one);
    out[k].edge_band = edge_band(one, out[k].assembly);
  });
  return out;
}

StaticModel::StaticModel(const Scene& scene, std::vector<SeedAssembly> assemblies, int threads)
    : assemblies_(std::make_shared<const std::vector<SeedAssembly>>(std::move(assemblies))),
      by_modulus_(scene.contact && std::holds_alternative<ContactModulus>(scene.contact->stiffness)),
      deformation_(scene.deformation.value_or(DeformationParameters{})),
      seeds_(assemblies_->size()),
      threads_(threads) {
  if (by_modulus_)
    mean_stiffness_ = mean(normal_stiffnesses(assemblies_->front().assembly, contact({}, 1.0)));
}

StaticModel StaticModel::variant(const DeformationParameters& deformation) const {
  StaticModel other = *this;
  other.deformation_ = deformation;
  return other;
}

StaticModel StaticModel::first_seed() const {
  StaticModel other = *this;
  other.seeds_ = 1;
  return other;
}

ContactParameters StaticModel::contact(const ModelPoint& point, double stiffness) const {
  ContactParameters c;
  c.stiffness_ratio = point.stiffness_ratio;
  (by_modulus_ ? c.contact_modulus : c.normal_stiffness) = stiffness;
  return c;
}

DeformationParameters StaticModel::discs(const ModelPoint& point, double stiffness) const {
  DeformationParameters d = deformation_;
  if (!d.active()) return d;
  d.young_modulus = stiffness * mean_stiffness_ / (point.softness * assemblies_->front().assembly.thickness);
  d.poisson_ratio = point.particle_poisson_ratio;
  return d;
}

MeanModuli StaticModel::at(const ModelPoint& point, std::span<const Parameter> rates) const {
  struct OfSeed {
    SeedModuli moduli;
    std::vector<YoungPoisson> rates;
  };
  std::vector<OfSeed> of_seed(seeds_);
  const ContactParameters c = contact(point, 1.0);
  const DeformationParameters d = discs(point, 1.0);
  run_jobs(seeds_, threads_, [&](std::size_t k) {
    const SeedAssembly& a = (*assemblies_)[k];
    const StiffnessRates s = homogenise_with_rates(a.assembly, c, d, a.edge_band, rates);
    const IsotropicModuli m = isotropic_part(s.stiffness);
    of_seed[k].moduli = {m.young(), m.poisson()};
    for (const PlaneStiffness& rate : s.rates) of_seed[k].rates.push_back(rate_of(m, isotropic_part(rate)));
  });
  MeanModuli out;
  out.young_rates.assign(rates.size(), 0.0);
  out.poisson_rates.assign(rates.size(), 0.0);
  const double weight = 1.0 / static_cast<double>(seeds_);
  for (const OfSeed& s : of_seed) {
    out.seeds.push_back(s.moduli);
    out.young += weight * s.moduli.young;
    out.poisson += weight * s.moduli.poisson;
    for (std::size_t p = 0; p < rates.size(); ++p) {
      out.young_rates[p] += weight * s.rates[p].young;
      out.poisson_rates[p] += weight * s.rates[p].poisson;
    }
  }
  return out;
}

std::vector<double> StaticModel::radii_per_softness(std::span<const ModelPoint> points) const {
  std::vector<double> radius(seeds_ * points.size());
  run_jobs(radius.size(), threads_, [&](std::size_t job) {
    ModelPoint unit = points[job / seeds_];
    unit.softness = 1.0;
    radius[job] =
        fixed_point_radius((*assemblies_)[job % seeds_].assembly, contact(unit, 1.0), discs(unit, 1.0));
  });
  std::vector<double> largest;
  for (auto of_point = radius.begin(); of_point != radius.end();
       of_point += static_cast<std::ptrdiff_t>(seeds_)) {
    largest.push_back(*std::max_element(of_point, of_point + static_cast<std::ptrdiff_t>(seeds_)));
  }
  return largest;
}

std::optional<double> StaticModel::radius_limit() const {
  if (deformation_.scheme != Scheme::lagged) return std::nullopt;
  return 2.0 / deformation_.relaxation - 1.0;
}

double StaticModel::mean_solid_fraction() const {
  std::vector<double> fractions;
  for (const SeedAssembly& a : *assemblies_) fractions.push_back(solid_fraction(a.assembly));
  return mean(fractions);
}

}  // namespace ddem::harness
