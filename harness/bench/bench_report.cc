#include "harness/bench/bench_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "harness/bench/roofline.h"
#include "harness/bench/scaling_figure.h"
#include "harness/provenance/provenance.h"
#include "reports/number.h"

namespace ddem::harness::bench {
namespace {


reports::Color color_of(const PrecisionPoint& p) {
  using enum reports::Color;
  if (p.solver == "FE") {
    const std::map<char, reports::Color> by_degree{{'1', blue}, {'2', green}, {'4', orange}, {'8', vermilion}};
    const auto found = by_degree.find(p.scheme.at(1));
    return found == by_degree.end() ? automatic : found->second;
  }
  return p.scheme.starts_with("rigid") ? blue : p.scheme == "lagged" ? green : purple;
}

/// One series for each `name` of the points that have one, in their order; error against seconds.
template <class Name>
void add_series(reports::Plot& plot, const std::vector<PrecisionPoint>& points, const Name& name, double PrecisionPoint::* error) {
  for (const PrecisionPoint& p : points) {
    const std::string called = name(p);
    if (called.empty() || p.steps == 0) continue;
    auto series = std::find_if(plot.series.begin(), plot.series.end(), [&](const auto& s) { return s.name == called; });
    if (series == plot.series.end()) {
      plot.series.push_back({.name = called, .kind = reports::SeriesKind::line_markers, .color = color_of(p)});
      series = std::prev(plot.series.end());
      if (called.ends_with("bar") || p.scheme.ends_with("exact")) series->dash = reports::Dash::dashed;
    }
    series->x.push_back(p.seconds);
    series->y.push_back(p.status == "ok" ? p.*error : reports::kNone);
  }
}

reports::Plot panel(const std::string& title) {
  return {.title = title,
          .x = {.label = "time of solving", .unit = "s", .scale = reports::Scale::log},
          .y = {.label = "relative error (L2)", .scale = reports::Scale::log}};
}

reports::Table kernel_table(const std::vector<KernelTime>& kernels) {
  reports::Table t;
  t.caption = "Median of repetitions in random order (Google Benchmark) at 0.3 of the critical step; setting up is not counted. Over DEM (of deformable discs "
              "with k_t = 0: over DEM with k_t = 0): ratio of the medians.";
  t.columns = {{"law"}, {"packing"}, {"stiffness"}, {"discs", "", 7}, {"threads"}, {"time", "ns per bond and step", 3}, {"best", "ns", 3}, {"over DEM", "", 3}, {"arrays", "bytes a bond", 3}};
  for (const KernelTime& k : kernels) {
    t.rows.push_back({k.law, name_of(k.arrangement), k.per_bond_stiffness ? "per bond" : "uniform", k.discs, k.threads, k.nanoseconds_per_bond_step, k.best, k.over_dem, k.bytes_per_bond});
  }
  return t;
}

reports::Table fem_kernel_table(const std::vector<FemKernelTime>& kernels) {
  reports::Table t;
  t.caption = "Finite elements, with critical step and receivers: best of the rounds.";
  t.columns = {{"degree"}, {"elements"}, {"dofs", "", 7}, {"threads"}, {"speed", "million dof-steps per second", 3}, {"over one thread", "", 3}, {"bits of one thread"}};
  for (const FemKernelTime& k : kernels) {
    t.rows.push_back({k.mesh.degree, fmt::format("{} x {}", k.mesh.elements[0], k.mesh.elements[1]), k.dofs, k.threads, 1e-6 * k.dof_steps_per_second, k.over_one_thread, k.same_bits ? "yes" : "no"});
  }
  return t;
}

reports::Table precision_table(const std::vector<PrecisionPoint>& points) {
  reports::Table t;
  t.caption = "Seconds: best of several runs. Error: finite elements against d'Alembert; discs against the exact motion of the same lattice, "
              "and against the continuum.";
  t.columns = {{"solver"}, {"scheme"}, {"mesh"}, {"discs or dofs", "", 7}, {"step", "of critical", 3}, {"time", "s", 3}, {"error", "", 3}, {"to continuum", "", 3}, {"status"}};
  for (const PrecisionPoint& p : points) {
    const bool ok = p.status == "ok";
    t.rows.push_back({p.solver, p.scheme, p.mesh, p.discs_or_dofs, p.step_fraction, p.seconds, ok ? p.error : reports::kNone, ok ? p.error_to_continuum : reports::kNone, p.status});
  }
  return t;
}

reports::Table peer_table(const std::vector<PeerTime>& peers) {
  reports::Table t;
  t.caption = "In turns, one thread; every program's own time of its loop.";
  t.columns = {{"program"}, {"version"}, {"law"}, {"discs", "", 7}, {"its time", "ns per bond and step", 3}, {"ddem", "ns per bond and step", 3}, {"ratio", "", 3}, {"difference of displacements", "", 2}};
  for (const PeerTime& p : peers) {
    t.rows.push_back({p.program, p.version, p.law, p.discs, p.nanoseconds_per_bond_step, p.ddem_nanoseconds_per_bond_step, p.ratio, p.difference});
  }
  return t;
}

}  // namespace

reports::Figure precision_figure(const std::vector<PrecisionPoint>& points) {
  reports::Figure figure{.id = "work-precision",
                         .title = "Run time against error",
                         .caption = "Finite elements: a Gaussian pulse against d'Alembert's solution, a line for each degree and wave (dashed: the bar with "
                                    "ν = 0), a mark for each mesh. Discs: a Gaussian shear pulse in the hexagonal lattice; first against the exact motion "
                                    "of the same lattice, which leaves the error of the time step and of lagging (a mark for each step, and one exact in time), then against "
                                    "the continuum, which adds that of the discs' size. Times depend on the machine and on what else it does."};
  reports::Plot fem = panel("finite elements, against d'Alembert");
  add_series(fem, points, [](const PrecisionPoint& p) { return p.solver == "FE" ? p.scheme : std::string(); }, &PrecisionPoint::error);
  if (!fem.series.empty()) figure.panels.push_back(fem);
  const auto disc_name = [](const PrecisionPoint& p) { return p.solver == "FE" ? std::string() : fmt::format("{}, {} discs", p.scheme, p.mesh); };
  reports::Plot lattice = panel("discs, against the exact lattice"), continuum = panel("discs, against the continuum");
  add_series(lattice, points, disc_name, &PrecisionPoint::error);
  add_series(continuum, points, disc_name, &PrecisionPoint::error_to_continuum);
  if (!lattice.series.empty()) figure.panels.insert(figure.panels.end(), {lattice, continuum});
  return figure;
}

reports::Section precision_section(const std::vector<PrecisionPoint>& points) {
  reports::Section section{.heading = "Run time against error",
          .paragraphs = {"A small measurement among the campaign's other runs, which slow it down; \"ddem bench\" takes more meshes, sizes and "
                         "repetitions, times every law and compares with LAMMPS and Yade. Seconds are not judged."},
          .figures = {precision_figure(points)}};
  for (const PrecisionPoint& p : points) {
    if (p.status != "ok") section.paragraphs.push_back(fmt::format("{} {} {}: {}", p.solver, p.scheme, p.mesh, p.status));
  }
  return section;
}

reports::Report bench_report(const BenchResults& r) {
  reports::Report report;
  report.title = "ddem bench";
  report.summary = {fmt::format("Memory bandwidth (STREAM triad): {:.1f} GB/s with one thread, {:.1f} GB/s at most ({} threads). Times are of this machine, "
                                "at this hour; ratios between what ran in turns travel better.",
                                r.triad_one_thread, r.triad, r.triad_threads)};
  if (!r.kernels.empty()) {
    const std::vector<Bandwidth> bandwidths{{1, r.triad_one_thread}, {r.triad_threads, r.triad}};
    report.sections.push_back({.heading = "Cost of a bond and step", .figures = {roofline_figure(r.kernels, bandwidths)}, .tables = {kernel_table(r.kernels)}});
  }
  if (!r.fem_kernels.empty()) report.sections.push_back({.heading = "Speed of the finite elements", .tables = {fem_kernel_table(r.fem_kernels)}});
  if (!r.scaling.empty()) report.sections.push_back({.heading = "Time and memory against the number of discs", .figures = {scaling_figure(r.scaling)}, .tables = {scaling_table(r.scaling)}});
  if (!r.work_precision.empty()) {
    reports::Section section{.heading = "Work-precision", .figures = {precision_figure(r.work_precision)}, .tables = {precision_table(r.work_precision)}};
    if (!r.fem_failure.empty()) section.paragraphs.push_back("No finite elements: " + r.fem_failure);
    report.sections.push_back(section);
  }
  reports::Section peers{.heading = "Other programs"};
  if (!r.peers.reason.empty()) peers.paragraphs.push_back(r.peers.reason);
  if (!r.peers.times.empty()) peers.tables.push_back(peer_table(r.peers.times));
  report.sections.push_back(peers);
  report.provenance = provenance();
  report.provenance.emplace_back("wall time", fmt::format("{:.1f} s", r.wall_seconds));
  return report;
}

}  // namespace ddem::harness::bench
