#include "harness/studies/solvers/solvers_figures.h"

#include <fmt/format.h>

#include <cmath>

namespace ddem::harness {
namespace {

std::string law_name(const SolverTask& t) { return fmt::format("{}, {}, kₜ/kₙ = {:g}", t.packing, t.law, t.stiffness_ratio); }

reports::Plot error_panel(std::span<const ComparedSolver> compared) {
  reports::Plot plot{.title = "displacements against the built-in solver",
                     .x = {.label = "amplitude / mean radius", .scale = reports::Scale::log},
                     .y = {.label = "largest difference / largest displacement", .scale = reports::Scale::log}};
  for (const ComparedSolver& c : compared) {
    if (!c.found.failure.empty()) continue;
    reports::Series s{.name = law_name(c.task), .kind = reports::SeriesKind::line_markers, .x = {1e-6}, .y = {std::max(c.found.displacement_error, 1e-17)}};
    for (std::size_t k = 0; k < c.found.amplitude.size(); ++k) {
      s.x.push_back(c.found.amplitude[k]);
      s.y.push_back(std::max(c.found.amplitude_error[k], 1e-17));
    }
    plot.series.push_back(std::move(s));
  }
  plot.references.push_back({.value = 1e-4, .label = "accepted at 1e-6"});
  return plot;
}

reports::Plot signal_panel(const ComparedSolver& c) {
  reports::Plot plot{.title = law_name(c.task), .x = {.label = "time", .unit = "s"}, .y = {.label = "displacement in the middle", .unit = "m"}};
  plot.series.push_back({.name = "built-in", .x = c.found.time, .y = c.found.builtin_signal, .color = reports::Color::grey});
  plot.series.push_back({.name = c.task.label, .x = c.found.time, .y = c.found.signal, .color = reports::Color::vermilion, .dash = reports::Dash::dashed});
  return plot;
}

reports::Cell number_or_dash(const std::optional<double>& value) { return value ? reports::Cell(*value) : reports::Cell("–"); }

}  // namespace

reports::Figure solver_figure(std::span<const ComparedSolver> compared) {
  const std::string& label = compared.front().task.label;
  reports::Figure figure{.id = "solver-" + label,
                         .title = label + " beside the built-in solver",
                         .caption = "First: how far the motions of all discs differ. A solver that takes the geometry of the moment differs in proportion to the "
                                    "amplitude; one of linear kinematics by round-off alone; a wrong parameter shows at every amplitude alike. Then: the middle "
                                    "disc of the first law and the last that it can do."};
  figure.panels.push_back(error_panel(compared));
  const ComparedSolver *first = nullptr, *last = nullptr;
  for (const ComparedSolver& c : compared) {
    if (!c.found.failure.empty()) continue;
    if (first == nullptr) first = &c;
    last = &c;
  }
  if (first != nullptr) figure.panels.push_back(signal_panel(*first));
  if (last != first) figure.panels.push_back(signal_panel(*last));
  return figure;
}

reports::Table solver_table(std::span<const ComparedSolver> compared) {
  reports::Table t;
  t.caption = "Differences over the largest displacement (rotation) of the built-in solver, at 1e-6 mean radii; speeds by peak over that of the built-in solver, "
              "and over the static speed; order of the change when the step is halved; time of its loop, one process.";
  t.columns = {{"solver"}, {"strip"}, {"law"}, {"kₜ/kₙ", "", 2}, {"displacements", "", 2}, {"rotations", "", 2}, {"order in amplitude", "", 2}, {"speed / built-in - 1", "%", 3},
               {"speed / static - 1", "%", 2}, {"order in step", "", 2}, {"energy drift", "", 2}, {"a bond and step", "ns", 3}, {"built-in", "ns", 3}, {"", ""}};
  for (const ComparedSolver& c : compared) {
    const SolverResult& r = c.found;
    std::vector<reports::Cell> row = {c.task.label, c.task.packing, c.task.law, c.task.stiffness_ratio};
    if (!r.failure.empty()) {
      for (int k = 0; k < 9; ++k) row.push_back("–");
      row.push_back(r.failure);
    } else {
      const auto percent = [](double a, double b) { return a > 0.0 && b > 0.0 ? reports::Cell(100.0 * (a / b - 1.0)) : reports::Cell("–"); };
      row.insert(row.end(), {r.displacement_error, c.task.stiffness_ratio > 0.0 ? reports::Cell(r.rotation_error) : reports::Cell("–"), number_or_dash(r.amplitude_order()),
                             percent(r.speed, r.builtin_speed), percent(r.speed, r.static_speed), number_or_dash(r.order()), number_or_dash(r.energy_drift),
                             r.nanoseconds, r.builtin_nanoseconds, r.version});
    }
    t.rows.push_back(std::move(row));
  }
  return t;
}

}  // namespace ddem::harness
