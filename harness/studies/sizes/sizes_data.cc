#include "harness/io/errors.h"
#include "harness/studies/sizes/sizes_data.h"

#include <algorithm>
#include <cmath>

#include "dem/assembly/contacts.h"
#include "dem/core/narrow.h"
#include "dem/spectra/spectra.h"
#include "dem/statics/moduli.h"
#include "harness/studies/strip/strip_results.h"
#include "harness/studies/strip/whole.h"
#include "harness/model/assemble.h"
#include "harness/model/packing_store.h"
#include "harness/references/effective_moduli.h"
#include "harness/run/bar_reference.h"
#include "harness/run/dem_run.h"
#include "harness/run/section_speeds.h"
#include "meshes/packings/hexagonal.h"
#include "meshes/packings/tile.h"
#include "reports/number.h"

namespace ddem::harness {
namespace {


// Larger strips are left out: their statics alone take minutes.
constexpr std::int64_t kMostDiscs = 20000;

constexpr std::int64_t kFinest = 4;
constexpr std::size_t kFinestSeeds = 3;

/// Jamming thousands of discs takes seconds: finer strips are copies, side by side, of a cell as wide as the strip, of at most
/// half as many discs as the coarsest one has, but no shorter than half its width. What repeats has stop bands at waves of
/// twice its length and less, of the default campaign 4 mm (8 copies) and 2 mm (16), and the pulse has none below 4 mm. Four
/// copies, with a band at 8 mm, take 0.17 % from the bar wave's speed.
int cells_of(const StripCampaign& s, std::int64_t refinement) {
  if (refinement == 1) return 1;
  int cells = static_cast<int>(2 * refinement * refinement);
  while (cells > 1 && s.length / cells < 0.5 * s.width) cells /= 2;
  return cells;
}

/// The campaign's strip with smaller discs.
StripCampaign refined(StripCampaign s, std::int64_t refinement) {
  s.discs *= refinement * refinement;
  s.columns *= refinement;
  s.rows *= refinement;
  s.step_fraction = std::min(0.8, s.step_fraction * static_cast<double>(refinement));  // the same step in seconds
  return s;
}

/// Periodic in both directions.
struct PeriodicSample {
  Packing packing;
  double bond_gap = 0.0;  ///< m
};

PeriodicSample sample_of(const StripCampaign& s, const SizedStrip& strip) {
  if (strip.packing == StripPacking::hexagonal) {
    const double radius = s.length / static_cast<double>(2 * s.columns + 1);
    return {packings::hexagonal({.columns = narrow<int>(s.columns, "columns"), .rows = narrow<int>(s.rows, "rows"), .radius = radius, .periodic_x = true, .periodic_y = true}),
            0.1 * radius};
  }
  const Packing cell = stored_random_packing({.length = s.length / strip.cells,
                                              .width = s.width,
                                              .discs = narrow<int>(s.discs / strip.cells, "discs"),
                                              .seed = static_cast<std::uint64_t>(strip.seed)});
  return {strip.cells > 1 ? packings::tile(cell, strip.cells, 1) : cell, gap_for_coordination(cell, s.coordination)};
}

ddem::Assembly cut(const StripCampaign& s, const PeriodicSample& m, bool free_edges) {
  Packing p = m.packing;
  const Bonds bonds = cut_at_edges(p, bonds_within_gap(p, m.bond_gap), true, free_edges);
  p.period = {0.0, free_edges ? 0.0 : p.width};
  return make_assembly(p, bonds, 1.0, s.density, RattlerRule::peel);
}

/// One material with its edges open and closed, and what statics say of it.
struct Strips {
  ddem::Assembly free = {}, closed = {};
  double edge_band = 0.0;           ///< m
  double critical_time_step = 0.0;  ///< of the closed strip; the free one lacks some of its bonds, so that its own is longer
  StripTension tension = {};
  DirectionalSpeeds directional = {};
  std::optional<GrippedStrip> grips = {};  ///< of the closed one
};

DemRun run_wave(const StripCase& c, const Strips& strips, const Scene& scene, double expected, const Solver& solver) {
  RunOptions options;
  options.solver = &solver;
  options.expected_speed = expected;
  options.critical_time_step = strips.critical_time_step;
  options.warn = false;
  DemRun run = run_assembly(scene, c.wave == StripWave::bar ? strips.free : strips.closed, options);
  if (run.result.breakdown || !run.measurement) throw std::runtime_error(id_of(c) + ": the run broke down");
  return run;
}

/// P and shear share their strip and its sections.
void send_waves(const StripCampaign& s, SizedStrip& strip, double stiffness_ratio, const Strips& strips, const Solver& solver) {
  const bool lattice = strip.packing == StripPacking::hexagonal;
  const auto closed_form = references::bulk_wave_speeds(
      references::effective_moduli(references::ContactModel::dem, references::hexagonal_fabric(), {s.normal_stiffness, stiffness_ratio}, {}),
      s.density * references::hexagonal_fabric().solid_fraction);
  const double bar_speed = strips.tension.bar_velocity();
  const auto send = [&](StripWave wave, double expected, SizedWave& out, const auto& measure) {
    const StripCase c{strip.packing, strip.seed, Model::dem, stiffness_ratio, Protocol::long_wave, wave};
    const Scene scene = scene_of(scene_text(s, c, expected), id_of(c));
    const DemRun run = run_wave(c, strips, scene, expected, solver);
    out.measured = picked_speeds(*run.measurement);
    measure(run);
  };
  send(StripWave::shear, strips.directional.s, strip.shear, [&](const DemRun& run) {
    const auto sections = lattice ? StaticSections::Speeds{closed_form.p, closed_form.shear, 0.0} : section_speeds(*strips.grips, run.layout);
    strip.shear.reference = sections.s;
    strip.p.reference = sections.p;
  });
  send(StripWave::p, strips.directional.p, strip.p, [](const DemRun&) {});
  send(StripWave::bar, bar_speed, strip.bar, [&](const DemRun& run) {
    strip.bar.reference = bar_speed;
    const PickedSpeeds s0 = picked_speeds(s0_measurement({bar_speed, run.assembly.packing.width, strips.tension.lateral_contraction.value()}, run.layout, run.context));
    const auto over = [&](std::optional<double> speed) { return speed ? std::optional(*speed / bar_speed) : std::nullopt; };
    strip.bar.s0 = {over(s0.peak), over(s0.centroid), over(s0.correlation)};
  });
}

template <class Value>
std::vector<SizeMean> means_of(const std::vector<SizedStrip>& strips, StripPacking packing, const Value& value) {
  std::vector<SizeMean> means;
  std::vector<std::int64_t> refinements;
  for (const SizedStrip& s : strips) refinements.push_back(s.refinement);
  std::sort(refinements.begin(), refinements.end());
  refinements.erase(std::unique(refinements.begin(), refinements.end()), refinements.end());
  for (const std::int64_t refinement : refinements) {
    std::vector<double> values, sizes;
    for (const SizedStrip& s : strips) {
      if (s.packing != packing || s.refinement != refinement || !s.failure.empty()) continue;
      values.push_back(value(s));
      sizes.push_back(s.radius_over_width);
    }
    if (!values.empty()) means.push_back({sample_statistics(sizes).value, sample_statistics(values), values.size()});
  }
  return means;
}

}  // namespace

double SizedWave::error() const { return measured.centroid ? *measured.centroid / (reference * s0.centroid.value_or(1.0)) - 1.0 : reports::kNone; }

std::vector<SizeMean> SizeStudy::mean_bias(StripPacking packing, std::size_t ratio) const {
  return means_of(strips, packing, [&](const SizedStrip& s) { return s.bias[ratio].value(); });
}

std::vector<SizeMean> SizeStudy::mean_error(StripPacking packing, StripWave wave) const {
  return means_of(strips, packing, [&](const SizedStrip& s) { return s.wave(wave).error(); });
}

PowerLaw power_law(const std::vector<SizeMean>& means) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const SizeMean& m : means) {
    const double u = std::log(m.radius_over_width), v = m.value.value < 0.0 ? std::log(-m.value.value) : reports::kNone;
    n += 1.0, x += u, y += v, xx += u * u, xy += u * v;
  }
  const double power = (n * xy - x * y) / (n * xx - x * x);
  return {-std::exp((y - power * x) / n), power};
}

double hexagonal_width_bias(double stiffness_ratio, double rows) {
  const double b = 2.0 * stiffness_ratio / (3.0 + stiffness_ratio);
  return std::sqrt((rows + (rows - 1.0) * b) / (rows * (1.0 + b))) - 1.0;
}

void require_whole(const SizedStrip& found, std::size_t stiffness_ratios) {
  if (!found.failure.empty()) return;
  require_length("bar speeds of a strip", found.bias.size(), stiffness_ratios);
  require(found.radius_over_width > 0.0, "a strip whose discs have no size");
}

SizeStudy plan_sizes(const StripCampaign& s) {
  SizeStudy study;
  for (const std::int64_t refinement : {kFinest, std::int64_t{2}, std::int64_t{1}}) {
    if (std::max(s.discs, s.columns * s.rows) * refinement * refinement > kMostDiscs) continue;
    study.strips.push_back({.packing = StripPacking::hexagonal, .refinement = refinement});
    const std::size_t seeds = refinement == kFinest ? std::min(kFinestSeeds, s.seeds.size()) : s.seeds.size();
    for (std::size_t k = 0; k < seeds; ++k) {
      study.strips.push_back({.packing = StripPacking::random, .refinement = refinement, .seed = s.seeds[k], .cells = cells_of(s, refinement)});
    }
  }
  return study;
}

void measure_strip(const StripCampaign& campaign, SizeStudy& study, std::size_t k, const Solver& solver) {
  SizedStrip& strip = study.strips[k];
  try {
    const StripCampaign s = refined(campaign, strip.refinement);
    const PeriodicSample m = sample_of(s, strip);
    Strips strips{.free = cut(s, m, true), .closed = cut(s, m, false)};
    strip.discs = static_cast<std::int64_t>(strips.free.size());
    strip.radius_over_width = mean_radius(m.packing) / m.packing.width;
    const StripCase any{strip.packing, strip.seed, Model::dem, 0.0, Protocol::long_wave, StripWave::bar};
    strips.edge_band = edge_band(scene_of(assembly_text(s, any, false), "sizes"), strips.free);
    ContactParameters contact;
    contact.normal_stiffness = s.normal_stiffness;
    for (const double ratio : study.stiffness_ratios) {
      contact.stiffness_ratio = ratio;
      strips.tension = pull_strip(strips.free, contact, {}, strips.edge_band);
      strips.grips.emplace(strips.closed, contact, DeformationParameters{}, strips.edge_band);
      strips.directional = directional_speeds(strips.grips->stiffness(), moving_density(strips.closed));
      strip.bias.push_back({strips.tension.bar_velocity(), strips.directional.bar});
    }
    strips.critical_time_step = 2.0 / largest_frequency(strips.closed, contact, {});
    send_waves(s, strip, contact.stiffness_ratio, strips, solver);
  } catch (const UnsupportedError&) {  // no failure, but what a solver cannot do
    throw;
  } catch (const std::exception& e) {
    strip.failure = e.what();
  }
}

}  // namespace ddem::harness
