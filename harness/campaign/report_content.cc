#include "harness/campaign/report_content.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/bench/bench_report.h"
#include "harness/campaign/calibration_study.h"
#include "harness/campaign/design_figure.h"
#include "harness/campaign/dispersion_figures.h"
#include "harness/campaign/facets.h"
#include "harness/campaign/figures.h"
#include "harness/campaign/formulas.h"
#include "harness/campaign/paper_bias.h"
#include "harness/campaign/pickers.h"
#include "harness/campaign/scheme_figures.h"
#include "harness/campaign/size_figures.h"
#include "harness/campaign/stability_figures.h"
#include "harness/campaign/static_figures.h"
#include "harness/measure/elastic_constants.h"
#include "harness/provenance/provenance.h"
#include "reports/number.h"

namespace ddem::harness {
namespace {

std::string range_text(const std::vector<double>& values) {
  std::vector<double> finite;
  for (const double v : values) {
    if (std::isfinite(v)) finite.push_back(v);
  }
  if (finite.empty()) return "not measured";
  const auto [lo, hi] = std::minmax_element(finite.begin(), finite.end());
  return fmt::format("{:.3f} to {:.3f}", *lo, *hi);
}

std::vector<reports::Headline> headlines(const CampaignResults& r) {
  std::vector<reports::Headline> out;
  if (!r.has_waves()) return out;
  for (const Model model : r.campaign.models) {
    const PoissonCurve measured = poisson_curve(r, model);
    out.push_back(
        {fmt::format("ν reached, {}", name(model)), range_text(measured.mean), "random packings, from P and shear waves, over kₜ/kₙ"});
  }
  return out;
}

/// Mean bulk density of the random packings, kg/m3.
double mean_density(const CampaignResults& r, Model model, double ratio) {
  std::vector<double> densities;
  for (const StaticOutcome& s : r.statics) {
    if (s.key.packing == StripPacking::random && s.key.model == model && s.key.stiffness_ratio == ratio)
      densities.push_back(s.moduli.bulk_density);
  }
  return sample_statistics(densities).value;
}

struct ElasticConstants {
  double young = std::numeric_limits<double>::quiet_NaN(), shear = young, poisson = young;
};

/// E and G from bar and shear speed; nu from P and shear where there is a P wave, else from bar and shear.
ElasticConstants elastic_constants(double density, const Uncertain& bar, const Uncertain& shear, const Uncertain* p) {
  ElasticConstants e;
  if (std::isfinite(bar.value)) e.young = young_modulus_from_bar(density, bar).value;
  if (std::isfinite(shear.value)) e.shear = shear_modulus_from_shear(density, shear).value;
  if (p != nullptr && std::isfinite(p->value) && std::isfinite(shear.value)) e.poisson = poisson_ratio_from_p_and_shear(*p, shear).value;
  if (p == nullptr && std::isfinite(bar.value) && std::isfinite(shear.value))
    e.poisson = poisson_ratio_from_bar_and_shear(bar, shear).value;
  return e;
}

/// One row a model and ratio: each wave's measured velocity, how far it is from the static one, and what follows.
reports::Table speed_table(const CampaignResults& r, Protocol protocol) {
  const bool with_p = protocol == Protocol::long_wave;
  reports::Table t;
  t.caption = with_p ? "Driven long pulse, section averages: mean over the random packings."
                     : "The paper's protocol, column release and peak to peak: mean over the random packings.";
  t.columns = {{"model"}, {"kₜ/kₙ", "", 3}};
  std::vector<StripWave> waves = {StripWave::bar, StripWave::shear};
  if (with_p) waves.push_back(StripWave::p);
  for (const StripWave wave : waves) {
    t.columns.push_back({name(wave), "m/s", 5});
    t.columns.push_back({"− static", "%", 2});
  }
  t.columns.insert(t.columns.end(), {{"E", "GPa", 4}, {"G", "GPa", 4}, {with_p ? "ν (P, shear)" : "ν (bar, shear)", "", 3}});
  for (const Model model : r.campaign.models) {
    for (const double ratio : r.campaign.stiffness_ratios) {
      std::vector<reports::Cell> row = {name(model), ratio};
      std::vector<Uncertain> speeds;
      for (const StripWave wave : waves) {
        const SpeedPoint s = random_speed(r, model, ratio, protocol, wave);
        row.insert(row.end(), {s.measured.value, 100.0 * (s.measured.value / s.statics - 1.0)});
        speeds.push_back(s.measured);
      }
      const ElasticConstants e = elastic_constants(mean_density(r, model, ratio), speeds[0], speeds[1], with_p ? &speeds[2] : nullptr);
      row.insert(row.end(), {e.young * 1e-9, e.shear * 1e-9, e.poisson});
      t.rows.push_back(row);
    }
  }
  return t;
}

reports::Section overview(const CampaignResults& r) {
  return {
      .heading = "Poisson's ratio and wave velocities",
      .paragraphs = {"A standard DEM of bonded discs couples elasticity to the contact stiffnesses alone. In DDEM every disc also "
                     "takes a uniform strain from the mean stress of its contact forces, which changes the overlap at all its contacts. "
                     "Velocities are measured on driven pulses much longer than a disc, and compared with static moduli of the very "
                     "same assemblies, with kinematic closed forms, and with a finite-element model that has the static moduli."},
      .figures = {poisson_figure(r), velocity_figure(r)},
      .tables = {speed_table(r, Protocol::long_wave)}};
}

reports::Section statics(const CampaignResults& r) {
  reports::Section section{
      .heading = "Wave speeds without time steps",
      .paragraphs = {"Long waves travel at speeds that static moduli give, sqrt(G/ρ) and sqrt((K + G)/ρ), and the lattice's plane waves "
                     "give them too, as ω/k for k → 0. Neither takes a time step: ddem validate --static makes this section alone, "
                     "for all materials of the campaign."},
      .figures = {speed_error_figure(r)},
      .tables = {speed_error_table(r)}};
  if (!r.has_waves()) section.figures.push_back(static_speed_figure(r));
  return section;
}

reports::Section waves(const CampaignResults& r) {
  return {.heading = "Waves",
          .paragraphs = {"Each probe's signal is searched for its largest peak between the first possible arrival and the first "
                         "reflection; a quadratic through the top 6 % of the pulse gives the time. A pick that fails is reported "
                         "with its reason and gives no velocity. Driven pulses are measured by their centroid and by cross-correlation as "
                         "well: where the "
                         "three differ, dispersion or scatter of the packing bends the pulse. Their reference is the static speed between "
                         "the very sections, from "
                         "the compliance and the mass of what lies between."},
          .figures = {r.film ? film_figure(*r.film) : strip_figure(r), paper_figure(r), waveform_figure(r)},
          .tables = {picker_table(r)}};
}

reports::Section schemes(const CampaignResults& r) {
  return {
      .heading = "Which scheme to choose",
      .paragraphs =
          {"The published scheme takes the strains of the discs from the forces of the step before. The lag is a viscosity of first order "
           "in the step, and it limits how soft the discs may be. Implicit strains belong to the forces of the same step: second order, no "
           "limit, and with the full (or normal-only-stress) correction an energy that is kept to round-off, for some more time a step. "
           "They cost the more the softer the discs. Conjugate gradients from the strains of the step before find the same strains "
           "more slowly than the fixed polynomial, and keep the energy to their tolerance only."},
      .figures = {scheme_figure(*r.schemes)},
      .tables = {scheme_table(*r.schemes)}};
}

reports::Section stability(const CampaignResults& r) {
  return {.heading = "Stability",
          .paragraphs = {"A step of any of these schemes is a linear map. Its eigenvalues say how fast which motion grows: on the lattice "
                         "they come from plane "
                         "waves, in a small random packing from the matrix itself. The very schemes are then run, and what they do is "
                         "measured. Prediction and "
                         "measurement must agree within 2 %, and noise must blow up where it should, and nowhere else."},
          .figures = stability_figures(r.stability_maps),
          .tables = {stability_table(r.stability_maps)}};
}

reports::Section sizes(const CampaignResults& r) {
  return {
      .heading = "Smaller discs",
      .paragraphs =
          {"The strip of the paper is nine discs wide. The same strip out of smaller discs shows which errors are those of its width in "
           "discs. "
           "The largest is static: the free edges soften the bar, in proportion to radius over width, so that its speed is not that of the "
           "material. Strips of 16 times as many discs repeat one jammed cell, as wide as the strip; the table says how many copies."},
      .figures = {size_figure(*r.sizes)},
      .tables = {size_table(*r.sizes)}};
}

reports::Section paper(const CampaignResults& r) {
  return {
      .heading = "The paper's protocol, and its bias",
      .paragraphs =
          {"The discs of the left edge are displaced and let go; velocities are measured peak to peak between single discs, bar between "
           "free "
           "edges, shear between periodic ones, and Poisson's ratio follows from c_bar² = 2 (1 + ν) c_shear². Three things come between "
           "that number "
           "and the material's.",
           "First the free edges: bonds are missing there, the layer along them is softer, and a strip few discs wide is slower than its "
           "own bulk: by 4 to 5 % at nine discs and a coordination of 5.8. No measuring can take that out, since it is a property of the "
           "strip; it lowers ν by "
           "2 (1 + ν) times as much, 0.08 to 0.13 there, and it vanishes in proportion to radius over width. Second the waves: a released "
           "column sends waves as short as the discs, "
           "which the packing scatters and delays, and the bar disperses (S0), at fixed width whatever the size of the discs; what the "
           "peak of "
           "a single disc shows is off by some per cent either way, from packing to packing. Third the anisotropy of a single packing, for "
           "which bar and shear along one "
           "direction do not belong to one ν.",
           "P and shear velocities between periodic edges have none of the first error, and driven long pulses, averaged over sections, "
           "little of the second: "
           "hence the headline is measured with them. The first table compares velocities with the static ones of the same strips, the "
           "second "
           "follows Poisson's ratio from the material to the protocol."},
      .figures = {paper_poisson_figure(r)},
      .tables = {speed_table(r, Protocol::paper), paper_poisson_table(r)}};
}

reports::Section calibration(const CampaignResults& r) {
  return {.heading = "Contacts for a material that you want",
          .paragraphs = {"Targets were calibrated as ddem calibrate does: kₙ by scale, kₜ/kₙ (and the discs' softness and νₚ) by "
                         "Newton's method on static moduli. "
                         "In the lattice what was found must be the closed form. In random packings the contacts found are put into scenes, and the "
                         "moduli of these are measured anew: of the packings that were fitted, and of others, which scatter. A target "
                         "out of reach must be refused."},
          .figures = {design_figure(r)},
          .tables = {calibration_table(r.calibrations)}};
}

/// What lacks results cannot always be drawn: the report is there all the same, and says so.
void leave_out_undrawable(reports::Section& section) {
  std::erase_if(section.figures, [&](const reports::Figure& figure) {
    try {
      reports::require_valid(figure);
      return false;
    } catch (const std::invalid_argument& e) {
      section.paragraphs.push_back(fmt::format("Not drawn: {}", e.what()));
      return true;
    }
  });
}

}  // namespace

reports::Report report_of(const CampaignResults& r, const std::vector<reports::Verdict>& verdicts,
                          const std::vector<reports::Section>& more) {
  const StripCampaign& s = r.campaign;
  reports::Report report;
  if (!r.has_strip) return {.title = "Campaign", .verdicts = verdicts, .sections = more, .provenance = provenance()};
  report.title = s.title;
  report.summary = {
      fmt::format("Strips of {:g} mm × {:g} mm: {} random discs (coordination {:g}, seeds {}) and a hexagonal lattice of {} × {}; "
                  "disc density {:g} kg/m³, kₙ = {} N/m, kₙ/Eₚ = {:g}, νₚ = {:g}. DDEM N and F are the published "
                  "scheme, in which the strains of the discs come from the forces of the step before: N corrects normal overlaps, "
                  "as published; F corrects both and derives from an energy. F implicit takes strains and forces of the same step.",
                  s.length * 1e3, s.width * 1e3, s.discs, s.coordination, fmt::join(s.seeds, ", "), s.columns, s.rows, s.density,
                  reports::number_text(s.normal_stiffness), s.normal_stiffness / s.particle_modulus, s.particle_poisson_ratio)};
  report.headlines = headlines(r);
  report.verdicts = verdicts;
  for (reports::Verdict& v : report.verdicts) v.facets = facets_of(v.case_id);
  if (r.has_waves()) report.sections = {overview(r), waves(r), paper(r)};
  if (r.range) report.sections.front().figures.push_back(range_figure(*r.range));
  if (r.film) report.sections[1].figures.push_back(energy_figure(*r.film));
  if (r.dispersion) report.sections[1].figures.push_back(dispersion_figure(*r.dispersion));
  report.sections.push_back(statics(r));
  if (r.sizes) report.sections.push_back(sizes(r));
  if (!r.calibrations.empty()) report.sections.push_back(calibration(r));
  if (r.schemes) report.sections.push_back(schemes(r));
  if (!r.stability_maps.empty()) report.sections.push_back(stability(r));
  if (!r.work_precision.empty()) report.sections.push_back(bench::precision_section(r.work_precision));
  if (r.discrimination) {
    report.sections.push_back({.heading = "Would an error be noticed?",
                               .paragraphs = {"Parameters are made wrong by 1 and 5 % in what the solvers are given, while the references "
                                              "keep the right ones."},
                               .tables = {discrimination_table(*r.discrimination)}});
  }
  report.sections.insert(report.sections.end(), more.begin(), more.end());
  report.sections.push_back(formulas_section());
  for (reports::Section& section : report.sections) leave_out_undrawable(section);
  report.provenance = provenance();
  report.provenance.emplace_back("simulations", std::to_string(r.waves.size()));
  report.provenance.emplace_back("finite-element runs", r.fem_failure.empty() ? std::to_string(r.fem.size()) : r.fem_failure);
  report.provenance.emplace_back("seeds", fmt::format("{}", fmt::join(s.seeds, ", ")));
  report.provenance.emplace_back("wall time", fmt::format("{:.1f} s", r.wall_seconds));
  return report;
}

}  // namespace ddem::harness
