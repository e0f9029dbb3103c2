// Driven long pulses through every material of the strip, and pictures of it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "harness/campaign/pieces.h"
#include "harness/studies/strip/outside_members.h"
#include "harness/studies/strip/strip.h"
#include "harness/studies/waves/film.h"
#include "harness/studies/waves/pickers.h"
#include "harness/studies/waves/speed_table.h"
#include "harness/studies/waves/waves_figures.h"
#include "harness/studies/waves/waves_findings.h"
#include "harness/studies/waves/waves_pieces.h"
#include "harness/studies/waves/waves_verdicts.h"

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

class WavesStudy : public Study {
 public:
  explicit WavesStudy(std::shared_ptr<Strip> strip) : strip_(std::move(strip)) {
    for (const StripMaterial& m : materials_of(strip_->spec))
      pieces_.push_back(wave_piece(strip_, m, Protocol::long_wave, [this](StripPicture&& picture) { picture_ = std::move(picture); }));
    pieces_.push_back(piece_at(film_, "film", inputs_of(strip_->spec), 100, [s = strip_] { return film_strip(s->spec, *s->options.solver); }));
  }

  std::vector<Judged> judge() const override {
    std::vector<Judged> judged;
    const StripCampaign& s = strip_->spec;
    for (const StripMaterial& m : contacts_of(s, StripPacking::hexagonal)) {
      const StaticOutcome* statics = strip_->found.find(m);
      StaticOutcome missing;
      missing.key = m;
      judged.push_back({lattice_verdict(strip_->found, statics != nullptr ? *statics : missing), {statics_unit(m), waves_unit(m, Protocol::long_wave)}});
      const StripMaterial random{StripPacking::random, 0, m.model, m.stiffness_ratio};
      judged.push_back({random_verdict(strip_->found, random), {}});
      for (const StripMaterial& seed : all_seeds(s, random)) judged.back().units.push_back(waves_unit(seed, Protocol::long_wave));
      if (strip_->options.with_continuum) judged.back().units.emplace_back(kContinuumUnit);
    }
    return judged;
  }

  void introduce(reports::Report& report) const override {
    std::ranges::move(wave_findings(strip_->found), std::back_inserter(report.findings));
    for (const Model model : strip_->spec.models) {
      report.headlines.push_back({fmt::format("ν reached, {}", name(model)), range_text(poisson_curve(strip_->found, model).mean),
                                  "random packings, from P and shear waves, over kₜ/kₙ"});
    }
  }

  std::vector<reports::Section> sections() const override {
    const StripResults& r = strip_->found;
    reports::Section overview{
        .heading = kOverview,
        .paragraphs = {"A standard DEM of bonded discs couples elasticity to the contact stiffnesses alone. In DDEM every disc also "
                       "takes a uniform strain from the mean stress of its contact forces, which changes the overlap at all its contacts. "
                       "Velocities are measured on driven pulses much longer than a disc, and compared with static moduli of the very "
                       "same assemblies, with kinematic closed forms, and with a finite-element model that has the static moduli."},
        .figures = {poisson_figure(r), velocity_figure(r)},
        .tables = {speed_table(r, Protocol::long_wave)}};
    reports::Section waves{
        .heading = kWaves,
        .paragraphs = {"Each probe's signal is searched for its largest peak between the first possible arrival and the first "
                       "reflection; a quadratic through the top 6 % of the pulse gives the time. A pick that fails is reported "
                       "with its reason and gives no velocity. Driven pulses are measured by their centroid and by cross-correlation as "
                       "well: where the three differ, dispersion or scatter of the packing bends the pulse. Their reference is the static "
                       "speed between the very sections, from the compliance and the mass of what lies between."},
        .figures = {film_ ? film_figure(*film_) : strip_figure(picture_), waveform_figure(r)},
        .tables = {picker_table(r)}};
    if (film_) waves.figures.push_back(energy_figure(*film_));
    return {overview, waves};
  }

  nlohmann::json data() const override {
    nlohmann::json j = stored_waves(strip_->found, Protocol::long_wave);
    j["strip"] = picture_;
    return j;
  }

  void count(nightly::WorkCounts& work) const override { count_waves(strip_->found, Protocol::long_wave, work); }

 private:
  std::shared_ptr<Strip> strip_;
  StripPicture picture_;
  std::optional<StripFilm> film_;
};

}  // namespace

std::unique_ptr<Study> make_waves(const StudyContext& context) {
  return std::make_unique<WavesStudy>(strip_of(context));
}

}  // namespace ddem::harness
