#include "harness/io/errors.h"
#include "harness/studies/waves/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "harness/run/dem_run.h"
#include "harness/studies/strip/whole.h"

namespace ddem::harness {
namespace {

constexpr int kFrames = 24, kEnergySamples = 120;

/// One value of every disc at every frame; a snapshot without it (strain of rigid discs) has zeros.
template <class Take>
std::vector<double> over_time(const FilmedRun& run, const Take& take) {
  std::vector<double> values;
  for (const ddem::Snapshot& s : run.frames) {
    const std::vector<double>& of_discs = take(s);
    if (of_discs.empty())
      values.resize(values.size() + run.packing.size());
    else
      values.insert(values.end(), of_discs.begin(), of_discs.end());
  }
  return values;
}

const std::vector<double>& displacement(const ddem::Snapshot& s) {
  return s.state.ux;
}
const std::vector<double>& stress(const ddem::Snapshot& s) {
  return s.stress.xx;
}
const std::vector<double>& strain(const ddem::Snapshot& s) {
  return s.strain.xx;
}

/// Symmetric, and the same for all runs. The few values beyond, at the released edge, would leave the wave
/// without colour.
template <class Take>
reports::Limits common_limits(const StripFilm& film, const Take& take) {
  std::vector<double> sizes;
  for (const FilmedRun& run : film.runs) {
    for (const double v : over_time(run, take)) sizes.push_back(std::abs(v));
  }
  double largest = 0.0;
  if (!sizes.empty()) {
    const auto nearly_all =
        sizes.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(sizes.size() - 1));
    std::nth_element(sizes.begin(), nearly_all, sizes.end());
    largest = *nearly_all;
  }
  return largest > 0.0 ? reports::Limits{-largest, largest} : reports::Limits{-1.0, 1.0};
}

template <class Take>
void add_field(reports::Strip& strip, const FilmedRun& run, reports::Axis axis, reports::Limits limits,
               const Take& take) {
  axis.limits = limits;
  strip.fields.push_back({axis, over_time(run, take)});
}

}  // namespace

void require_whole(const StripFilm& found) {
  for (const FilmedRun& run : found.runs) {
    require_whole(run.packing);
    const std::size_t discs = run.packing.x.size();
    for (const ddem::Snapshot& s : run.frames) {
      require_length("displacements of a frame", s.state.ux.size(), discs);
      for (const ddem::TensorField* field : {&s.stress, &s.strain}) {
        if (!field->xx.empty()) require_length("a field of a frame", field->xx.size(), discs);
      }
    }
  }
}

StripFilm film_strip(const StripCampaign& s, const Solver& solver) {
  StripFilm film;
  film.stiffness_ratio =
      *std::min_element(s.stiffness_ratios.begin(), s.stiffness_ratios.end(),
                        [](double a, double b) { return std::abs(a - 0.3) < std::abs(b - 0.3); });
  // All models over the same time, frame by frame: as long as the last one, of the softest discs, takes to pass the last probe.
  std::optional<double> end;
  for (auto m = s.models.rbegin(); m != s.models.rend(); ++m) {
    const Model model = *m;
    const StripCase c{StripPacking::random, s.seeds.front(), model,
                      film.stiffness_ratio, Protocol::paper, StripWave::bar};
    RunOptions options;
    options.solver = &solver;
    options.warn = false;
    options.energy_samples = kEnergySamples;
    options.snapshots = model == s.models.front() || model == s.models.back() ? kFrames : 0;
    try {
      Scene scene = scene_of(scene_text(s, c, 1.0), "film");
      scene.time.integrator = Integrator::verlet;  // every disc is seen
      if (end) scene.time.end = EndTime{*end};
      const DemRun run = run_scene(scene, options);
      if (run.result.breakdown) {
        film.failure = fmt::format("{} diverged at step {}", name(model), run.result.breakdown->step);
        continue;
      }
      if (!end && !run.result.energy.empty()) end = run.result.energy.back().time;
      film.runs.push_back({model, run.assembly.packing, run.result.snapshots, run.result.energy});
      if (!film.probes.empty()) continue;
      for (std::size_t p = 0; p < run.layout.probes.size(); ++p) {
        const auto& probe = run.layout.probes[p];
        film.probes.push_back(
            {probe.x, probe.y,
             fmt::format("{}{}", static_cast<char>('A' + static_cast<int>(p / 2) % 26), p % 2 + 1)});
      }
    } catch (const UnsupportedError&) {  // no failure, but what a solver cannot do
      throw;
    } catch (const std::exception& e) {
      film.failure = e.what();
    }
  }
  std::reverse(film.runs.begin(), film.runs.end());
  return film;
}

reports::Figure film_figure(const StripFilm& film) {
  reports::Figure figure{.id = "strip", .title = "A wave through the random strip"};
  const reports::Limits u = common_limits(film, displacement), sigma = common_limits(film, stress),
                        eps = common_limits(film, strain);
  double shown = 0.0;
  for (const FilmedRun& run : film.runs) {
    if (run.frames.empty()) continue;
    const ddem::Snapshot& half_way = run.frames[run.frames.size() / 2];
    shown = half_way.time;
    reports::Strip strip{.title = fmt::format("{}, kₜ/kₙ = {:g}", name(run.model), film.stiffness_ratio),
                         .x = run.packing.x,
                         .y = run.packing.y,
                         .radius = run.packing.radius,
                         .value = half_way.state.ux,
                         .value_axis = {.label = "displacement along x", .unit = "m", .limits = u},
                         .probes = film.probes};
    for (const ddem::Snapshot& s : run.frames) strip.times.push_back(s.time);
    add_field(strip, run, {.label = "displacement along x", .unit = "m"}, u, displacement);
    add_field(strip, run, {.label = "stress σxx of the discs", .unit = "Pa"}, sigma, stress);
    add_field(strip, run, {.label = "strain εxx of the discs"}, eps, strain);
    figure.panels.emplace_back(std::move(strip));
  }
  figure.caption = fmt::format(
      "The discs of the left edge are displaced and let go (bar, free edges); the wave runs to the right, "
      "over the probes: velocities are measured "
      "from A1 to A2, B1 to B2 and so on. Red: to the right, or tension; blue: to the left, or compression; "
      "one value in a hundred is beyond "
      "the colours. Rigid discs (DEM) have stress but no strain of their own. On paper: {:.1f} µs after the "
      "release.",
      shown * 1e6);
  return figure;
}

reports::Figure energy_figure(const StripFilm& film) {
  reports::Figure figure{.id = "energy",
                         .title = "Energy over time, column release",
                         .caption =
                             "What is released as energy of the contacts is half kinetic at once, and stays "
                             "so. Rigid discs and strains of the same step (implicit) "
                             "keep the sum; lagged strains (N, F) damp waves as short as the discs, which a "
                             "released column mostly sends, and lose "
                             "most of it. Rigid discs store none themselves."};
  for (const FilmedRun& run : film.runs) {
    reports::Plot plot{.title = fmt::format("{}, kₜ/kₙ = {:g}", name(run.model), film.stiffness_ratio),
                       .x = {.label = "time", .unit = "s"},
                       .y = {.label = "energy", .unit = "J"}};
    reports::Series sum{.name = "sum", .color = reports::Color::black},
        kinetic{.name = "kinetic", .color = reports::Color::blue},
        contact{.name = "contacts", .color = reports::Color::vermilion},
        particle{.name = "discs", .color = reports::Color::green};
    for (const ddem::EnergySample& e : run.energy) {
      for (reports::Series* series : {&sum, &kinetic, &contact, &particle}) series->x.push_back(e.time);
      sum.y.push_back(e.energies.invariant);
      kinetic.y.push_back(e.energies.kinetic);
      contact.y.push_back(e.energies.contact);
      particle.y.push_back(e.energies.particle);
    }
    plot.series = {sum, kinetic, contact};
    if (run.model != Model::dem) plot.series.push_back(particle);
    figure.panels.emplace_back(std::move(plot));
  }
  return figure;
}

}  // namespace ddem::harness
