#include "harness/campaign/units.h"

#include <fmt/format.h>

#include <chrono>
#include <memory>

#include "harness/bench/bench.h"
#include "harness/campaign/figures.h"
#include "harness/campaign/noise_release.h"
#include "harness/campaign/results_json.h"
#include "harness/campaign/strip_fem.h"
#include "harness/campaign/strip_waves.h"

namespace ddem::harness {
namespace {

using nlohmann::json;

/// What the units of a campaign have in common. They own it together.
struct Shared {
  StripCampaign campaign;
  CampaignOptions options;
  StripStatics statics;
  StabilityGrid grid;
};
using SharedCampaign = std::shared_ptr<Shared>;

/// The title changes no result.
json inputs_of(StripCampaign s) {
  s.title.clear();
  return s;
}

/// Of one material: whichever others there are.
json inputs_of(const StripCampaign& s, const StripMaterial& m) {
  StripCampaign alone = s;
  alone.models = {m.model};
  alone.stiffness_ratios = {m.stiffness_ratio};
  alone.seeds = {m.seed};
  alone.full_stability = false;
  json inputs = inputs_of(alone);
  inputs["solved_as"] = continuum_model(s, m.model);
  inputs["for_figures"] = {m.seed == s.seeds.front(), shows_strip(s, m), m.stiffness_ratio == shown_ratio(s)};
  return inputs;
}

/// "random-1/lagged-full/kt0.30".
std::string slug_of(const StripMaterial& m) {
  const std::string packing =
      m.packing == StripPacking::hexagonal ? "hexagonal" : fmt::format("random-{}", m.seed);
  return packing + "/" + material_slug(m.model, m.stiffness_ratio);
}

template <class Result, class Take>
auto taking(const Take& take) {
  return [take](const json& j, CampaignResults& r) { take(j.get<Result>(), r); };
}

/// Of a released column's short waves a figure shows every sample, at one ratio; driven pulses are smooth.
void keep_shown(const StripCampaign& s, MaterialOutcome& m) {
  for (WaveOutcome& w : m.waves) {
    const bool whole = w.c.protocol == Protocol::paper && w.c.stiffness_ratio == shown_ratio(s);
    if (!whole) w.recording = thinned(w.recording);
  }
}

CampaignUnit material_unit(const SharedCampaign& c, const StripMaterial& m, std::size_t k,
                           std::size_t first_wave) {
  const auto run = [c, m] {
    c->statics.of(m);  // kept: the clock is for the waves
    const auto start = std::chrono::steady_clock::now();
    MaterialOutcome found = run_material(c->campaign, m, c->statics, c->options);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    for (WaveOutcome& w : found.waves) w.seconds = elapsed.count() / static_cast<double>(found.waves.size());
    keep_shown(c->campaign, found);
    return json(found);
  };
  const auto take = [k, first_wave](MaterialOutcome&& found, CampaignResults& r) {
    if (found.waves.size() != cases_of(found.statics.key).size() || found.statics.key != r.statics[k].key) {
      throw std::runtime_error("the result is another material's");
    }
    r.statics[k] = std::move(found.statics);
    std::move(found.waves.begin(), found.waves.end(),
              r.waves.begin() + static_cast<std::ptrdiff_t>(first_wave));
    if (found.picture) r.picture = std::move(*found.picture);
  };
  const auto miss = [k, first_wave, count = cases_of(m).size()](const std::string& reason,
                                                                CampaignResults& r) {
    r.statics[k].failure = reason;
    for (std::size_t n = 0; n < count; ++n) r.waves[first_wave + n].failure = reason;
  };
  return {{"material/" + slug_of(m), inputs_of(c->campaign, m).dump(), 4 + cases_of(m).size(), run},
          taking<MaterialOutcome>(take),
          miss};
}

void add_materials(const SharedCampaign& c, std::vector<CampaignUnit>& units) {
  std::size_t k = 0, first_wave = 0;
  for (const StripMaterial& m : materials_of(c->campaign)) {
    units.push_back(material_unit(c, m, k, first_wave));
    ++k;
    first_wave += cases_of(m).size();
  }
}

/// Statics alone.
void add_statics(const SharedCampaign& c, std::vector<CampaignUnit>& units) {
  const auto materials = materials_of(c->campaign);
  for (std::size_t k = 0; k < materials.size(); ++k) {
    const StripMaterial m = materials[k];
    units.push_back(
        {{"statics/" + slug_of(m), inputs_of(c->campaign, m).dump(), 1, [c, m] { return json(c->statics.of(m)); }},
         taking<StaticOutcome>([k](StaticOutcome&& found, CampaignResults& r) {
           if (found.key != r.statics[k].key) throw std::runtime_error("the result is another material's");
           r.statics[k] = std::move(found);
         }),
         [k](const std::string& reason, CampaignResults& r) { r.statics[k].failure = reason; }});
  }
}

void add_noise(const SharedCampaign& c, std::vector<CampaignUnit>& units) {
  const auto lattices = lattices_with_strain(c->campaign);
  for (std::size_t k = 0; k < lattices.size(); ++k) {
    const StripMaterial m = lattices[k];
    units.push_back(
        {{"noise/" + slug_of(m), inputs_of(c->campaign, m).dump(), 4,
          [c, m] { return json(release_noise(c->campaign, m, c->options)); }},
         taking<StabilityOutcome>(
             [k](StabilityOutcome&& found, CampaignResults& r) { r.stability[k] = std::move(found); }),
         [k](const std::string& reason, CampaignResults& r) { r.stability[k].failure = reason; }});
  }
}

void add_maps(const SharedCampaign& c, std::vector<CampaignUnit>& units) {
  for (std::size_t k = 0; k < c->grid.maps.size(); ++k) {
    units.push_back(
        {{"stability-map/" + slug(c->grid.maps[k]), inputs_of(c->campaign).dump(), 1,
          [c, k] { return json(map_stability(c->campaign, c->grid, c->grid.maps[k])); }},
         taking<StabilityMap>(
             [k](StabilityMap&& found, CampaignResults& r) { r.stability_maps[k] = std::move(found); }),
         [k](const std::string& reason, CampaignResults& r) { r.stability_maps[k].failure = reason; }});
  }
}

void add_sizes(const SharedCampaign& c, std::vector<CampaignUnit>& units) {
  const std::size_t count = plan_sizes(c->campaign).strips.size();
  for (std::size_t k = 0; k < count; ++k) {
    const auto run = [c, k] {
      SizeStudy study = plan_sizes(c->campaign);
      measure_strip(c->campaign, study, k);
      return json(study.strips[k]);
    };
    const SizedStrip strip = plan_sizes(c->campaign).strips[k];
    const std::string packing =
        strip.packing == StripPacking::hexagonal ? "hexagonal" : fmt::format("random-{}", strip.seed);
    units.push_back(
        {{fmt::format("sizes/{}/refined-{}", packing, strip.refinement), inputs_of(c->campaign).dump(), 1,
          run},
         taking<SizedStrip>(
             [k](SizedStrip&& found, CampaignResults& r) { r.sizes->strips[k] = std::move(found); }),
         [k](const std::string& reason, CampaignResults& r) { r.sizes->strips[k].failure = reason; }});
  }
}

void add_calibrations(const SharedCampaign& c, std::vector<CampaignUnit>& units) {
  const std::string inputs = inputs_of(c->campaign).dump();
  const auto cases = calibration_cases();
  for (std::size_t k = 0; k < cases.size(); ++k) {
    units.push_back(
        {{id_of(cases[k]), inputs, 1,
          [c, one = cases[k]] { return json(study_calibration(c->campaign, one, c->options)); }},
         taking<CalibrationOutcome>(
             [k](CalibrationOutcome&& found, CampaignResults& r) { r.calibrations[k] = std::move(found); }),
         [k](const std::string& reason, CampaignResults& r) { r.calibrations[k].failure = reason; }});
  }
  units.push_back({{"design-curves", inputs, 1, [c] { return json(study_design(c->campaign)); }},
                   taking<DesignStudy>(
                       [](DesignStudy&& found, CampaignResults& r) { r.design = std::move(found); }),
                   [](const std::string&, CampaignResults& r) { r.design.reset(); }});
}

void add_studies(const SharedCampaign& c, std::vector<CampaignUnit>& units) {
  const std::string inputs = inputs_of(c->campaign).dump();
  const auto done = [c] {
    if (c->options.on_progress) c->options.on_progress(1);
  };
  units.push_back(
      {{"schemes", inputs, kSchemeStudyWork, [c, done] { return json(study_schemes(c->campaign, done)); },
        true},
       taking<SchemeStudy>([](SchemeStudy&& found, CampaignResults& r) { r.schemes = std::move(found); }),
       [](const std::string& reason, CampaignResults& r) { r.schemes->failure = reason; }});
  units.push_back({{"dispersion", fmt::format("{} {}", inputs, c->options.with_fem), 1,
                    [c] { return json(study_dispersion(c->campaign, c->options.with_fem)); }},
                   taking<DispersionStudy>(
                       [](DispersionStudy&& found, CampaignResults& r) { r.dispersion = std::move(found); }),
                   [](const std::string&, CampaignResults& r) { r.dispersion.reset(); }});
  units.push_back({{"discrimination", fmt::format("{} {}", inputs, c->options.with_fem), 1,
                    [c] { return json(study_discrimination(c->campaign, c->options.with_fem)); }},
                   taking<DiscriminationStudy>([](DiscriminationStudy&& found, CampaignResults& r) {
                     r.discrimination = std::move(found);
                   }),
                   [](const std::string&, CampaignResults& r) { r.discrimination.reset(); }});
  units.push_back(
      {{"poisson-range", inputs, 1, [c] { return json(study_range(c->campaign)); }},
       taking<RangeStudy>([](RangeStudy&& found, CampaignResults& r) { r.range = std::move(found); }),
       [](const std::string& reason, CampaignResults& r) { r.range->failure = reason; }});
  units.push_back({{"work-precision", "", 1, [] { return json(bench::measure_briefly()); }},
                   taking<std::vector<bench::PrecisionPoint>>(
                       [](auto&& found, CampaignResults& r) { r.work_precision = std::move(found); }),
                   [](const std::string&, CampaignResults& r) { r.work_precision.clear(); }});
}

void add_film(const SharedCampaign& c, std::vector<CampaignUnit>& units) {
  units.push_back({{"film", inputs_of(c->campaign).dump(), 1, [c] { return json(film_strip(c->campaign)); }},
                   taking<StripFilm>([](StripFilm&& found, CampaignResults& r) { r.film = std::move(found); }),
                   [](const std::string&, CampaignResults& r) { r.film.reset(); }});
}

void add_fem(const SharedCampaign& c, std::vector<CampaignUnit>& units) {
  units.push_back({{"finite-elements", inputs_of(c->campaign).dump(), fem_outcomes(c->campaign).size(),
                    [c] { return json(run_strip_fem(c->campaign, c->statics, c->options)); }, true},
                   taking<std::vector<FemOutcome>>(
                       [](std::vector<FemOutcome>&& found, CampaignResults& r) { r.fem = std::move(found); }),
                   [](const std::string& reason, CampaignResults& r) { r.fem_failure = reason; }});
}

}  // namespace

CampaignResults empty_results(const StripCampaign& s, const CampaignOptions& options) {
  const std::string not_run = "not run";
  CampaignResults r;
  r.campaign = s;
  for (const StripMaterial& m : materials_of(s)) {
    r.statics.emplace_back().key = m;
    r.statics.back().failure = not_run;
    if (!options.with_waves) continue;
    for (const StripCase& c : cases_of(m)) {
      r.waves.emplace_back().c = c;
      r.waves.back().failure = not_run;
    }
  }
  if (!options.with_waves) return r;
  for (const StripMaterial& m : lattices_with_strain(s)) {
    r.stability.push_back(
        {.key = m, .failure = not_run, .expected_unstable = expected_unstable(s, m), .diverged_step = {}});
  }
  if (options.with_fem) r.fem = fem_outcomes(s);
  for (FemOutcome& f : r.fem) f.failure = not_run;
  if (!options.with_studies) return r;
  r.schemes.emplace().failure = not_run;
  r.range.emplace().failure = not_run;
  for (const CalibrationCase& c : calibration_cases()) {
    r.calibrations.emplace_back().id = id_of(c);
    r.calibrations.back().failure = not_run;
  }
  if (SizeStudy sizes = plan_sizes(s); !sizes.strips.empty()) r.sizes = std::move(sizes);
  if (r.sizes) {
    for (SizedStrip& strip : r.sizes->strips) strip.failure = not_run;
  }
  for (const StabilityKey& key : stability_grid(s.full_stability).maps) {
    r.stability_maps.emplace_back().key = key;
    r.stability_maps.back().failure = not_run;
  }
  return r;
}

std::vector<CampaignUnit> units_of(const StripCampaign& s, const CampaignOptions& options) {
  const SharedCampaign c(new Shared{s, options, StripStatics(s, options), stability_grid(s.full_stability)});
  std::vector<CampaignUnit> units;
  if (!options.with_waves) {
    add_statics(c, units);
    return units;
  }
  if (options.with_fem) add_fem(c, units);
  if (options.with_studies) {
    add_sizes(c, units);
    add_studies(c, units);
    add_calibrations(c, units);
    add_maps(c, units);
  }
  add_film(c, units);
  add_noise(c, units);
  add_materials(c, units);
  return units;
}

std::vector<CampaignUnit> units_of(const std::vector<UserCase>& cases) {
  std::vector<CampaignUnit> units;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const UserCase c = cases[k];
    units.push_back(
        {{"case/" + c.id, inputs_of_case(c), 1, [c] { return json(run_user_case(c)); }},
         taking<UserCaseOutcome>(
             [k](UserCaseOutcome&& found, CampaignResults& r) { r.cases[k].found = std::move(found); }),
         [k](const std::string& reason, CampaignResults& r) { r.cases[k].found.failure = reason; }});
  }
  return units;
}

void take_outcome(const CampaignUnit& unit, const nightly::Outcome& outcome, CampaignResults& results) {
  std::string failure = outcome.failure;
  if (failure.empty()) {
    try {
      unit.take(outcome.result, results);
    } catch (const std::exception& e) {
      failure = std::string("its result cannot be read: ") + e.what();
    }
  }
  if (failure.empty()) return;
  unit.miss(failure, results);
  results.failed_units[unit.unit.id] = failure;
}

}  // namespace ddem::harness
