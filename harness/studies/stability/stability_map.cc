#include "harness/io/errors.h"
#include "harness/studies/stability/stability_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/studies/stability/growth.h"

namespace ddem::harness {
namespace {

// Strains that move no disc grow from round-off, 1e-16 of the start and less, and are seen before a motion of growth g has
// grown by e^35 if they grow faster than 2 g.
constexpr double kDrowned = 1.5;

const char* slug(Correction c) { return c == Correction::normal ? "normal" : c == Correction::full ? "full" : "normal-only-stress"; }
const char* symbol(Correction c) { return c == Correction::normal ? "N" : c == Correction::full ? "F" : "NN"; }

DeformationParameters strains(const StripCampaign& s, const StabilityKey& key, double softness) {
  DeformationParameters d;
  if (key.scheme == Scheme::none) return d;
  d.scheme = key.scheme;
  d.correction = key.correction;
  d.young_modulus = s.normal_stiffness / softness;
  d.poisson_ratio = key.particle_poisson_ratio;
  d.tolerance = 1e-8;  // so that any motion has the converged stiffness, which the predictions have, within 1e-6
  return d;
}

/// `in` as input_of() gives it.
StabilityPoint measure(const Subject& subject, SimulationInput in, double softness, double fraction, const StabilityGrid& grid) {
  in.time_step = fraction * subject.critical_step();
  const Start start = subject.worst(in.deformation, in.time_step);
  StabilityPoint point{softness, fraction, std::abs(start.factor) - 1.0, {}, false, {}, false};
  if (start.motionless > std::max(kNoGrowth, kDrowned * std::log(std::abs(start.factor)))) {
    point.predicted = std::expm1(start.motionless);
    point.unseen = true;
    return point;
  }
  if (grid.disturb) grid.disturb(in);
  point.measured = release(*grid.solver, subject, start, in);
  point.noise_grew = noise_grows(*grid.solver, subject, in);
  if (point.predicted > kNoiseGrowth) point.noise_should_grow = true;
  if (point.predicted < kGrowthFloor) point.noise_should_grow = false;
  return point;
}

std::vector<double> decades(double from, double to, int per_decade) {
  std::vector<double> values;
  const int n = static_cast<int>(std::lround(std::log10(to / from) * per_decade));
  for (int k = 0; k <= n; ++k) values.push_back(from * std::pow(10.0, static_cast<double>(k) / per_decade));
  return values;
}

/// Where no step is stable any more the limit drops: the softness of the drop is bracketed within 1 %.
void trace_boundary(StabilityMap& map, const std::function<double(double)>& largest_fraction) {
  const auto add = [&](double softness, double fraction) {
    map.boundary_softness.push_back(softness);
    map.boundary_fraction.push_back(fraction);
  };
  for (const double softness : decades(map.softness.front(), map.softness.back(), 8)) {
    const double fraction = largest_fraction(softness);
    if (fraction == 0.0 && !map.boundary_fraction.empty() && map.boundary_fraction.back() > 0.0) {
      double stable = map.boundary_softness.back(), unstable = softness;
      while (unstable > 1.01 * stable) {
        const double middle = std::sqrt(stable * unstable), there = largest_fraction(middle);
        if (there > 0.0) add(stable = middle, there);
        else unstable = middle;
      }
      add(unstable, 0.0);
    }
    add(softness, fraction);
  }
}

}  // namespace

std::string name(const StabilityKey& key) {
  const char* packing = key.packing == StripPacking::hexagonal ? "lattice" : "random";
  if (key.scheme == Scheme::none) return fmt::format("{}, DEM, kₜ/kₙ = {:g}", packing, key.stiffness_ratio);
  return fmt::format("{}, {} {}, kₜ/kₙ = {:g}, νₚ = {:g}", packing, key.scheme == Scheme::lagged ? "lagged" : "implicit", symbol(key.correction), key.stiffness_ratio,
                     key.particle_poisson_ratio);
}

std::string slug(const StabilityKey& key) {
  const char* packing = key.packing == StripPacking::hexagonal ? "hexagonal" : "random";
  if (key.scheme == Scheme::none) return fmt::format("{}/dem/kt{:.2f}", packing, key.stiffness_ratio);
  return fmt::format("{}/{}-{}/kt{:.2f}/nu{:.2f}", packing, key.scheme == Scheme::lagged ? "lagged" : "implicit", slug(key.correction), key.stiffness_ratio, key.particle_poisson_ratio);
}

StabilityGrid stability_grid(bool full) {
  StabilityGrid g;
  g.step_fraction = full ? std::vector<double>{0.02, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.99, 1.1}
                         : std::vector<double>{0.02, 0.15, 0.3, 0.45, 0.6, 0.75, 0.88, 0.99, 1.1};
  g.softness = decades(0.01, 10.0, full ? 8 : 2);
  g.random_step_fraction = full ? g.step_fraction : std::vector<double>{0.02, 0.3, 0.6, 0.9, 1.1};
  g.random_softness = decades(0.01, 10.0, full ? 4 : 2);
  if (full) g.random_discs = 40;
  const auto add = [&](StripPacking packing, const std::vector<double>& ratios, const std::vector<double>& poissons) {
    for (const double ratio : ratios) {
      g.maps.push_back({packing, Scheme::none, Correction::full, ratio, 0.0});
      for (const double nu : poissons) {
        for (const Scheme scheme : {Scheme::lagged, Scheme::implicit}) {
          for (const Correction c : {Correction::normal, Correction::full, Correction::normal_only_stress}) g.maps.push_back({packing, scheme, c, ratio, nu});
        }
      }
    }
  };
  if (full) {
    add(StripPacking::hexagonal, {0.0, 0.1, 0.3, 0.32, 0.35, 0.5, 1.0}, {0.0, 0.3, 0.45});
    add(StripPacking::random, {0.0, 0.3, 1.0}, {0.3, 0.45});
  } else {
    add(StripPacking::hexagonal, {0.3}, {0.3});
    add(StripPacking::random, {0.3}, {0.3});
  }
  if (!full) {  // without shear stiffness, where all corrections are one; the published correction beyond its limit
    g.maps.push_back({StripPacking::hexagonal, Scheme::lagged, Correction::full, 0.0, 0.3});
    g.maps.push_back({StripPacking::hexagonal, Scheme::implicit, Correction::full, 0.0, 0.3});
    g.maps.push_back({StripPacking::hexagonal, Scheme::lagged, Correction::normal, 0.5, 0.3});
  }
  return g;
}

double StabilityPoint::disagreement() const {
  if (unseen) return 0.0;
  if (!measured) return std::numeric_limits<double>::infinity();
  return std::abs(*measured - predicted) / std::max(std::abs(predicted), kGrowthFloor);
}

bool StabilityPoint::wrong_side() const {
  if (noise_should_grow && *noise_should_grow != noise_grew) return true;
  return measured && ((predicted > kGrowthFloor && *measured <= 0.0) || (predicted <= 0.0 && *measured > kGrowthFloor));
}

double StabilityMap::worst_disagreement() const {
  double worst = 0.0;
  for (const StabilityPoint& p : points) worst = std::max(worst, p.disagreement());
  return worst;
}

int StabilityMap::wrong_sides() const {
  return static_cast<int>(std::count_if(points.begin(), points.end(), [](const StabilityPoint& p) { return p.wrong_side(); }));
}

StabilityMap map_stability(const StripCampaign& s, const StabilityGrid& grid, const StabilityKey& key) {
  const bool lattice = key.packing == StripPacking::hexagonal, rigid = key.scheme == Scheme::none;
  StabilityMap map{key, "", rigid ? std::vector<double>{1.0} : lattice ? grid.softness : grid.random_softness,
                   lattice ? grid.step_fraction : grid.random_step_fraction, {}, {}, {}};
  try {
    const Subject subject = subject_of(s, grid, key);
    std::vector<SimulationInput> inputs;
    for (const double softness : map.softness) inputs.push_back(input_of(subject, strains(s, key, softness)));
    for (const double fraction : map.step_fraction) {
      for (std::size_t k = 0; k < inputs.size(); ++k) map.points.push_back(measure(subject, inputs[k], map.softness[k], fraction, grid));
    }
    // Without an energy a random packing has no sharp limit: it flutters at any step.
    if (rigid || (!lattice && key.correction == Correction::normal && key.stiffness_ratio > 0.0)) return map;
    trace_boundary(map, [&](double softness) { return subject.largest_step(strains(s, key, softness)) / subject.critical_step(); });
  } catch (const UnsupportedError&) {  // no failure, but what a solver cannot do
    throw;
  } catch (const std::exception& e) {
    map.failure = e.what();
  }
  return map;
}

}  // namespace ddem::harness
