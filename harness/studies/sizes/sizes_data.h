#pragma once
// What the strip's width in discs does to its waves: the same 16.5 mm x 2 mm out of 4 and 16 times as many discs, plain
// DEM. A free edge is softer than the bulk over a few discs, whatever their size, so that the bar's speed is too small by
// a share of radius over width; the waves themselves should travel at their static speed at any size.

#include <cstdint>
#include <string>
#include <vector>

#include "harness/solvers/solver.h"
#include "harness/studies/strip/strip_campaign.h"
#include "harness/measure/elastic_constants.h"
#include "harness/studies/waves/waves_data.h"

namespace ddem::harness {

/// The bar speed of the free strip and that of its own material without edges, both static.
struct WidthBias {
  double strip = 0.0, bulk = 0.0;  ///< m/s
  double value() const { return strip / bulk - 1.0; }
};

/// A driven long pulse, measured in three ways.
struct SizedWave {
  PickedSpeeds measured;   ///< m/s
  double reference = 0.0;  ///< static, m/s: between the same sections (a lattice: closed form); of the bar the pulled strip's
  PickedSpeeds s0;         ///< bar: what S0 makes of the strip's static speed, over that speed; else empty

  /// By centroid, over the reference (of the bar: times what S0 makes of it), less one; NaN where not measured.
  double error() const;
};

/// One strip.
struct SizedStrip {
  StripPacking packing = StripPacking::hexagonal;
  std::int64_t refinement = 1;  ///< of the discs' number along each side: 1, 2, 4
  std::int64_t seed = 0;
  std::string failure = {};     ///< empty: ok
  std::int64_t discs = 0;
  int cells = 1;                ///< copies, side by side, of a jammed cell as wide as the strip
  double radius_over_width = 0.0;
  std::vector<WidthBias> bias = {};  ///< one a SizeStudy::stiffness_ratios
  SizedWave bar = {}, shear = {}, p = {};  ///< at the last of them

  const SizedWave& wave(StripWave wave) const { return wave == StripWave::bar ? bar : wave == StripWave::shear ? shear : p; }
};

/// Means over the seeds of one size.
struct SizeMean {
  double radius_over_width = 0.0;
  Uncertain value;  ///< and the scatter of a single strip
  std::size_t strips = 0;
};

struct SizeStudy {
  std::vector<double> stiffness_ratios = {0.0, 0.25};  ///< k_t/k_n
  std::vector<SizedStrip> strips;

  /// Over those strips of a kind that did not fail, coarsest first.
  std::vector<SizeMean> mean_bias(StripPacking packing, std::size_t ratio) const;
  std::vector<SizeMean> mean_error(StripPacking packing, StripWave wave) const;
};

/// Bias = slope (radius/width)^power through the means (least squares of logarithms); NaN where one is not negative, and of
/// fewer than two.
struct PowerLaw {
  double slope = 0.0, power = 0.0;
};
PowerLaw power_law(const std::vector<SizeMean>& means);

/// What free edges take from the bar speed of the hexagonal lattice, rows along x: uniaxial tension is uniform in the very
/// strip, and only the bonds between its n rows carry shear, EA = 2 r k_n (n + (n - 1) b), b = 2 lambda/(3 + lambda).
double hexagonal_width_bias(double stiffness_ratio, double rows);

DDEM_MEMBERS(WidthBias, strip, bulk)
DDEM_MEMBERS(SizedWave, measured, reference, s0)
DDEM_MEMBERS(SizedStrip, packing, refinement, seed, failure, discs, cells, radius_over_width, bias, bar, shear, p)

/// Throws std::runtime_error where members that belong together do not fit: a result of another program.
void require_whole(const SizedStrip& found, std::size_t stiffness_ratios);

/// The strips of the study, of up to 20000 discs, nothing measured yet, the costliest first.
SizeStudy plan_sizes(const StripCampaign& campaign);
/// Measures study.strips[k]. Strips may be measured at the same time.
void measure_strip(const StripCampaign& campaign, SizeStudy& study, std::size_t k, const Solver& solver = builtin_solver());

}  // namespace ddem::harness
