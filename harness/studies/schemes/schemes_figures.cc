#include "harness/studies/schemes/schemes_figures.h"

#include "reports/number.h"

#include <fmt/format.h>

#include <cmath>

namespace ddem::harness {
namespace {


reports::Color scheme_color(const std::string& scheme) {
  if (scheme.starts_with("DEM")) return reports::Color::blue;
  if (scheme.starts_with("lagged,")) return reports::Color::orange;
  if (scheme.starts_with("lagged")) return reports::Color::green;
  return reports::Color::purple;
}

reports::Plot energy_panel(const SchemeStudy& study) {
  reports::Plot plot{.title = "energy of a free strip", .x = {.label = "time", .unit = "s"}, .y = {.label = "energy over that of step 200"}};
  for (const EnergyCurve& c : study.energy) {
    const bool gradients = c.scheme.ends_with("gradients");
    plot.series.push_back({.name = fmt::format("{}, dt = {:g} of critical", c.scheme, c.step_fraction), .x = c.time, .y = c.energy, .color = gradients ? reports::Color::black : scheme_color(c.scheme),
                           .dash = gradients || c.step_fraction < 0.1 ? reports::Dash::dashed : reports::Dash::solid});
  }
  return plot;
}

reports::Plot reach_panel(const SchemeStudy& study) {
  reports::Plot plot{.title = fmt::format("Poisson's ratio reached, νₚ = {:g}", study.reach_poisson_ratio),
                     .x = {.label = "kₙ/Eₚ", .scale = reports::Scale::log},
                     .y = {.label = "Poisson's ratio"}};
  reports::Series closed{.name = "closed form", .color = reports::Color::grey};
  for (const ReachCurve& c : study.reach) {
    reports::Series s{.name = c.scheme + (c.scheme.ends_with("strain") ? " a step" : " strains"), .kind = reports::SeriesKind::markers, .color = scheme_color(c.scheme)};
    for (const ReachPoint& p : c.points) s.x.push_back(p.softness), s.y.push_back(p.poisson.value_or(reports::kNone));
    plot.series.push_back(s);
  }
  if (!study.reach.empty()) {
    for (const ReachPoint& p : study.reach.front().points) closed.x.push_back(p.softness), closed.y.push_back(p.closed_form);
    plot.series.push_back(closed);
  }
  plot.references.push_back({.value = 1.0 / 3.0, .label = "1/3, DEM"});
  return plot;
}

reports::Plot order_panel(const SchemeStudy& study) {
  reports::Plot plot{.title = "error of a plane shear wave after two periods",
                     .x = {.label = "time step over critical", .scale = reports::Scale::log},
                     .y = {.label = "error over amplitude", .scale = reports::Scale::log}};
  for (const OrderCurve& c : study.order) {
    plot.series.push_back({.name = c.scheme, .kind = reports::SeriesKind::line_markers, .x = c.step_fraction, .y = c.error, .color = scheme_color(c.scheme)});
  }
  return plot;
}

}  // namespace

reports::Figure scheme_figure(const SchemeStudy& study) {
  return {.id = "schemes",
          .title = "Which scheme to choose",
          .caption = "First: rigid discs and implicit strains keep the energy of a free strip, lagged strains lose it, the faster the larger the step. "
                     "Second: lagged strains fail where kₙ/Eₚ passes their limit (their marks end: the run diverged); half of the new strain a step moves "
                     "the limit, implicit strains have none. Third: lagged strains are of first order in the step, the others of second.",
          .panels = {energy_panel(study), reach_panel(study), order_panel(study)}};
}

reports::Table scheme_table(const SchemeStudy& study) {
  reports::Table t;
  t.caption = "10000 steps of a free random strip, one thread, timed among the campaign's other runs.";
  t.columns = {{"scheme"}, {"step", "of critical", 2}, {"time", "ns per bond and step", 3}, {"over DEM", "", 2}, {"energy drift", "", 2}};
  for (const EnergyCurve& c : study.energy) {
    std::vector<reports::Cell> row = {c.scheme, c.step_fraction, c.nanoseconds_per_bond_step, c.nanoseconds_per_bond_step / study.energy.front().nanoseconds_per_bond_step};
    row.push_back(c.drift ? reports::Cell(*c.drift) : reports::Cell("diverged"));
    t.rows.push_back(row);
  }
  return t;
}

}  // namespace ddem::harness
