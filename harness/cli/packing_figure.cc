#include "harness/cli/packing_figure.h"

#include <fmt/format.h>

#include <algorithm>

#include "meshes/packings/pair_correlation.h"

namespace ddem::harness {
namespace {

constexpr double kFarthest = 5.0;  // sums of radii
constexpr int kBins = 100;
constexpr std::size_t kMostDrawn = 20000;  // discs; more make a file that no browser opens gladly

reports::Strip discs_of(const Packing& p) {
  reports::Strip strip{.x = p.x, .y = p.y, .radius = p.radius, .value = p.radius, .value_axis = {.label = "radius", .unit = "m"}};
  const auto [least, most] = std::ranges::minmax(p.radius);
  strip.value_axis.limits = least < most ? reports::Limits{least, most} : reports::Limits{0.9 * least, 1.1 * most};
  return strip;
}

reports::Plot radii_of(const Packing& p) {
  reports::Series curve;
  curve.x = p.radius;
  std::ranges::sort(curve.x);
  for (std::size_t k = 0; k < curve.x.size(); ++k) curve.y.push_back((static_cast<double>(k) + 0.5) / static_cast<double>(curve.x.size()));
  return {.title = "radii", .x = {.label = "radius", .unit = "m"}, .y = {.label = "share of the discs that are smaller"}, .series = {curve}};
}

reports::Plot distances_of(const Packing& p) {
  const packings::PairCorrelation c = packings::pair_correlation(p, kFarthest, kBins);
  reports::Series curve;
  for (std::size_t k = 0; k < c.g.size(); ++k) curve.x.push_back(c.width * (static_cast<double>(k) + 0.5)), curve.y.push_back(c.g[k]);
  return {.title = "distances",
          .x = {.label = "distance of centres over the sum of radii"},
          .y = {.label = "pair correlation g"},
          .series = {curve},
          .references = {{.value = 1.0, .label = "no order"}}};
}

}  // namespace

reports::Figure packing_figure(const Packing& p) {
  reports::Figure figure{.id = "packing",
                         .title = fmt::format("{} discs", p.size()),
                         .caption = "Discs coloured by their radius; their radii; and pairs at a distance over those of as many points without order.",
                         .panels = {radii_of(p), distances_of(p)}};
  if (p.size() <= kMostDrawn) figure.panels.insert(figure.panels.begin(), discs_of(p));
  return figure;
}

}  // namespace ddem::harness
