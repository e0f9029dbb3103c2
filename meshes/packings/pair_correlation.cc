#include "meshes/packings/pair_correlation.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "dem/assembly/contacts.h"

namespace ddem::packings {
namespace {

constexpr double kBelowHalf = 0.999;  // of half a period: close_pairs() wants more than twice the distance

/// The farthest that can be seen, in sums of radii, of which the largest is `diameter`.
double reach_of(const Packing& p, double diameter, double largest) {
  const auto allowed = [&](double period, double size) { return kBelowHalf * 0.5 * (period > 0.0 ? period : size) / diameter; };
  return std::min({largest, allowed(p.period.x, p.length), allowed(p.period.y, p.width)});
}

/// Whether everything within `distance` is inside, or repeats.
bool sees(const Packing& p, std::size_t disc, double distance) {
  const auto inside = [&](double centre, double size, double period) { return period > 0.0 || (centre >= distance && centre <= size - distance); };
  return inside(p.x[disc], p.length, p.period.x) && inside(p.y[disc], p.width, p.period.y);
}

}  // namespace

PairCorrelation pair_correlation(const Packing& packing, double largest, int bins) {
  if (!(largest > 0.0) || bins < 1) throw std::invalid_argument("a pair correlation needs a positive distance, and bins");
  const double diameter = 2.0 * *std::ranges::max_element(packing.radius);
  const double reach = reach_of(packing, diameter, largest);
  PairCorrelation result;
  result.width = reach / bins;

  // Of discs without order, disc i sees (2 pi s ds) (r_i + r_j)^2 / area of the others j between s and s + ds sums of radii.
  double r = 0.0, r2 = 0.0;
  for (const double radius : packing.radius) r += radius, r2 += radius * radius;
  std::vector<char> counted(packing.size(), 0);
  double expected = 0.0;
  for (std::size_t i = 0; i < packing.size(); ++i) {
    if (!sees(packing, i, reach * diameter)) continue;
    counted[i] = 1;
    const double radius = packing.radius[i], others = static_cast<double>(packing.size()) - 1.0;
    expected += radius * radius * others + 2.0 * radius * (r - radius) + r2 - radius * radius;
  }
  if (!(expected > 0.0) || !(reach > 1.0)) return {};
  expected *= std::numbers::pi / (packing.length * packing.width);

  std::vector<double> pairs(static_cast<std::size_t>(bins), 0.0);
  for (const ClosePair& c : close_pairs(packing, (reach - 1.0) * diameter)) {
    const double distance = std::sqrt(c.dx * c.dx + c.dy * c.dy) / (packing.radius[c.i] + packing.radius[c.j]);
    const auto bin = static_cast<std::size_t>(distance / result.width);
    if (bin < pairs.size()) pairs[bin] += counted[c.i] + counted[c.j];
  }
  for (int k = 0; k < bins; ++k) {
    const double inner = result.width * k, outer = result.width * (k + 1);
    result.g.push_back(pairs[static_cast<std::size_t>(k)] / (expected * (outer * outer - inner * inner)));
  }
  return result;
}

}  // namespace ddem::packings
