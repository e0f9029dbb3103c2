#include "harness/studies/stability/stability_figures.h"

#include "reports/number.h"

#include <fmt/format.h>

#include <cmath>

namespace ddem::harness {
namespace {

constexpr double kShownRatio = 0.3, kBeyondLimit = 0.5, kShownPoisson = 0.3;
constexpr double kAgreement = 0.02;

/// On the lattice those of full and implicit strains that differ to the eye.
bool is_shown(const StabilityKey& k) {
  if (k.scheme == Scheme::none || k.particle_poisson_ratio != kShownPoisson) return false;
  if (k.packing == StripPacking::random) return k.stiffness_ratio == kShownRatio;
  if (k.stiffness_ratio == 0.0) return k.correction == Correction::full;
  if (k.stiffness_ratio == kBeyondLimit) return k.scheme == Scheme::lagged && k.correction == Correction::normal;
  return k.stiffness_ratio == kShownRatio && (k.correction == Correction::full || (k.scheme == Scheme::lagged && k.correction == Correction::normal));
}

std::string title_of(const StabilityKey& key) {
  const std::string text = name(key);
  const std::size_t begin = text.find(", ") + 2;  // behind the packing, which the figure's title says
  return text.substr(begin, text.rfind(", ") - begin);
}

reports::Plot panel_of(const StabilityMap& map) {
  reports::HeatMap heat{.x = map.softness, .y = map.step_fraction, .value = {}, .value_axis = {.label = "growth a step", .limits = reports::Limits{1e-5, 1.0}},
                        .scale = reports::ColorScale::signed_log};
  for (const StabilityPoint& p : map.points) heat.value.push_back(p.measured.value_or(reports::kNone));
  reports::Plot plot{.title = title_of(map.key), .x = {.label = "kₙ/Eₚ", .scale = reports::Scale::log}, .y = {.label = "step over critical", .limits = reports::Limits{0.0, 1.15}}, .map = heat};
  if (!map.boundary_softness.empty()) {
    plot.series.push_back({.name = "predicted limit", .x = map.boundary_softness, .y = map.boundary_fraction, .color = reports::Color::black});
  }
  return plot;
}

reports::Figure figure_of(const std::vector<StabilityMap>& maps, StripPacking packing) {
  const bool lattice = packing == StripPacking::hexagonal;
  reports::Figure figure{
      .id = lattice ? "stability-lattice" : "stability-random",
      .title = lattice ? "Where the schemes are stable: the lattice" : "Where the schemes are stable: a small random packing",
      .caption = lattice ? "Colour: measured growth of a motion in a step, white where there is none, blue where it decays. Steps are given over the critical step of "
                           "rigid discs. Each run was released from the motion that theory says grows fastest, or, where nothing grows, decays slowest (but for motions that strain no disc). Grey: beyond the limit strains grow that are alike in all discs, and move none. Lagged strains damp where they "
                           "are stable, and fail where discs are soft or steps large; the published correction (N) fails everywhere once kₜ/kₙ exceeds 1/3, "
                           "slowly. Implicit strains keep the energy at any softness, up to the critical step of rigid discs."
                         : "As above. Here the published correction (N) has no energy: with implicit strains motions grow at any step (flutter), which no lattice "
                           "shows; with lagged strains the damping may hide it. It has no sharp limit to be drawn."};
  for (const StabilityMap& map : maps) {
    if (map.key.packing == packing && map.failure.empty() && is_shown(map.key)) figure.panels.emplace_back(panel_of(map));
  }
  return figure;
}

}  // namespace

std::vector<reports::Figure> stability_figures(const std::vector<StabilityMap>& maps) {
  return {figure_of(maps, StripPacking::hexagonal), figure_of(maps, StripPacking::random)};
}

reports::Table stability_table(const std::vector<StabilityMap>& maps) {
  reports::Table t;
  t.caption = "Growth a step, predicted and measured, and whether noise did what it should.";
  t.columns = {{"assembly and scheme"}, {"points"}, {"unstable"}, {"not measured"}, {"largest growth"}, {"largest disagreement", "%", 2}, {"wrong sides"}};
  for (const StabilityMap& m : maps) {
    double unstable = 0.0, growth = -1.0, unseen = 0.0;
    for (const StabilityPoint& p : m.points) {
      unstable += p.predicted > kGrowthFloor ? 1.0 : 0.0;
      unseen += p.unseen ? 1.0 : 0.0;
      growth = std::max(growth, p.predicted);
    }
    t.rows.push_back({name(m.key), static_cast<double>(m.points.size()), unstable, unseen, growth, 100.0 * m.worst_disagreement(), static_cast<double>(m.wrong_sides())});
  }
  return t;
}

reports::Verdict stability_map_verdict(const StabilityMap& map) {
  reports::Verdict v{.case_id = "stability-map/" + slug(map.key), .title = "Growth a step, predicted and measured: " + name(map.key), .reason = map.failure};
  const auto judge = [&](const std::string& metric, double actual, double upper, const std::string& derivation) {
    reports::Criterion c{.metric = metric, .target = 0.0, .lower = 0.0, .upper = upper, .derivation = derivation};
    if (map.failure.empty() && std::isfinite(actual)) {
      c.actual = actual;
      c.state = actual <= upper ? reports::State::pass : reports::State::fail;
    }
    v.criteria.push_back(c);
  };
  judge("largest disagreement of growth", map.worst_disagreement(), kAgreement,
        fmt::format("of the growth itself, or of {:g} a step where it is less; linear prediction separates the other motions of the packing to a few 1e-3", kGrowthFloor));
  judge("points on the wrong side", map.wrong_sides(), 0.0, "growth where theory says decay, or the reverse; noise that blows up or does not");
  v.state = reports::State::pass;
  for (const reports::Criterion& c : v.criteria) {
    if (c.state == reports::State::fail) v.state = reports::State::fail;
  }
  if (!map.failure.empty() || !std::isfinite(map.worst_disagreement())) v.state = reports::State::error;
  return v;
}

}  // namespace ddem::harness
