// Static moduli and Bloch limits of every material of the strip.
#include <fmt/format.h>

#include "harness/campaign/pieces.h"
#include "harness/studies/statics/statics_figures.h"
#include "harness/studies/statics/statics_verdicts.h"
#include "harness/studies/strip/outside_members.h"
#include "harness/studies/strip/strip.h"
#include "reports/number.h"

namespace ddem::harness {
namespace {

class StaticsStudy : public Study {
 public:
  explicit StaticsStudy(std::shared_ptr<Strip> strip) : strip_(std::move(strip)) {
    for (const StripMaterial& m : materials_of(strip_->spec)) {
      StaticOutcome& place = strip_->found.statics.emplace_back();
      place.key = m;
      place.failure = kNotRun;
      pieces_.push_back(piece_at(
          place, statics_unit(m), inputs_of(strip_->spec, m), 1, [s = strip_, m] { return s->statics.of(m); },
          [](const StaticOutcome& planned, const StaticOutcome& found) { return planned.key == found.key; }));
    }
  }

  std::vector<Judged> judge() const override {
    std::vector<Judged> judged;
    for (const StaticOutcome& s : strip_->found.statics) {
      if (s.key.packing != StripPacking::hexagonal) continue;
      const StripMaterial random{StripPacking::random, 0, s.key.model, s.key.stiffness_ratio};
      judged.push_back({static_verdict(s), {statics_unit(s.key)}});
      judged.push_back({random_static_verdict(strip_->found, random), {}});
      for (const StripMaterial& m : all_seeds(strip_->spec, random)) judged.back().units.push_back(statics_unit(m));
    }
    return judged;
  }

  std::vector<reports::Section> sections() const override {
    const StripResults& r = strip_->found;
    reports::Section section{
        .heading = "Wave speeds without time steps",
        .paragraphs = {"Long waves travel at speeds that static moduli give, sqrt(G/ρ) and sqrt((K + G)/ρ), and the lattice's plane waves "
                       "give them too, as ω/k for k → 0. Neither takes a time step: ddem validate --static makes this section alone, "
                       "for all materials of the campaign."},
        .figures = {speed_error_figure(r)},
        .tables = {speed_error_table(r)}};
    if (!r.has_waves()) section.figures.push_back(static_speed_figure(r));
    return {section};
  }

  nlohmann::json data() const override {
    nlohmann::json j = nlohmann::json::object();
    for (const StaticOutcome& s : strip_->found.statics) {
      nlohmann::json& outcome = j[slug_of(s.key)] = s;
      if (!s.failure.empty()) {  // no numbers, then
        outcome = {{"failure", s.failure}};
        continue;
      }
      outcome.erase("key");  // its name says it
      if (s.sections.bar == 0.0) outcome.erase("sections");
    }
    return j;
  }

 private:
  std::shared_ptr<Strip> strip_;
};

}  // namespace

std::unique_ptr<Study> make_statics(const StudyContext& context) {
  return std::make_unique<StaticsStudy>(strip_of(context));
}

}  // namespace ddem::harness
