#include "harness/bench/roofline.h"

#include <fmt/format.h>

#include <algorithm>

namespace ddem::harness::bench {
namespace {

reports::Series series_of(const std::string& law) {
  reports::Series s{.name = law, .kind = reports::SeriesKind::line_markers};
  s.color = law.starts_with("DEM") ? reports::Color::blue : law.starts_with("lagged") ? reports::Color::green : reports::Color::purple;
  s.dash = law.ends_with("k_t = 0") ? reports::Dash::dashed : reports::Dash::solid;
  return s;
}

reports::Plot panel(const std::vector<KernelTime>& kernels, Arrangement arrangement, const Bandwidth& bandwidth) {
  reports::Plot plot{.title = name_of(arrangement) + (bandwidth.threads == 1 ? ", one thread" : fmt::format(", {} threads", bandwidth.threads)),
                     .x = {.label = "bond-steps a byte of the solver's arrays", .scale = reports::Scale::log},
                     .y = {.label = "bond-steps a nanosecond", .scale = reports::Scale::log}};
  reports::Series roof{.name = "memory (STREAM triad)", .color = reports::Color::black};
  for (const KernelTime& k : kernels) {
    if (k.arrangement != arrangement || k.threads != bandwidth.threads || k.per_bond_stiffness) continue;
    auto series = std::find_if(plot.series.begin(), plot.series.end(), [&](const auto& s) { return s.name == k.law; });
    if (series == plot.series.end()) series = plot.series.insert(series, series_of(k.law));
    series->x.push_back(1.0 / k.bytes_per_bond);
    series->y.push_back(1.0 / k.nanoseconds_per_bond_step);
    roof.x.push_back(1.0 / k.bytes_per_bond);
  }
  if (roof.x.empty()) return plot;
  const auto [least, most] = std::minmax_element(roof.x.begin(), roof.x.end());
  roof.x = {0.8 * *least, 1.25 * *most};
  for (const double x : roof.x) roof.y.push_back(bandwidth.gb_per_s * x);
  plot.series.push_back(roof);
  return plot;
}

}  // namespace

reports::Figure roofline_figure(const std::vector<KernelTime>& kernels, const std::vector<Bandwidth>& bandwidths) {
  reports::Figure figure{.id = "roofline",
                         .title = "Roofline",
                         .caption = "Each law with one stiffness for all bonds, a mark for each size: 682 discs, whose arrays fit in the cache of a core, and "
                                    "more, whose arrays do not. No step that takes all of the solver's arrays from memory is above the line; sweeps of "
                                    "several steps over what is in cache are. Work is counted in steps of bonds, not in operations: laws that do more a "
                                    "bond are lower."};
  for (const Bandwidth& bandwidth : bandwidths) {
    for (const Arrangement arrangement : {Arrangement::lattice, Arrangement::random}) {
      reports::Plot plot = panel(kernels, arrangement, bandwidth);
      if (!plot.series.empty()) figure.panels.emplace_back(std::move(plot));
    }
  }
  return figure;
}

}  // namespace ddem::harness::bench
