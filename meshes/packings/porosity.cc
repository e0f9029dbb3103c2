#include "meshes/packings/porosity.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace ddem::packings {
namespace {

// Of the radii. Discs at half of their distance leave gaps as wide as a radius, which bonds can still bridge.
constexpr double kSmallest = 2.0 / 3.0, kLargest = 1.05;

}  // namespace

double porosity_of(const Packing& packing) {
  double area = 0.0;
  for (const double r : packing.radius) area += std::numbers::pi * r * r;
  return 1.0 - area / (packing.length * packing.width);
}

Packing with_porosity(Packing packing, double porosity, bool walled) {
  const double jammed = porosity_of(packing), largest = walled ? 1.0 : kLargest;
  const auto scaled = [&](double factor) { return 1.0 - (1.0 - jammed) * factor * factor; };
  const double factor = std::sqrt((1.0 - porosity) / (1.0 - jammed));
  if (!(factor >= kSmallest && factor <= largest))
    throw PorosityOutOfReach(fmt::format("a porosity of {:.4g} cannot be met: these discs jam at {:.4f}, and {:.4f} to {:.4f} can be had by scaling their radii",
                                            porosity, jammed, scaled(largest), scaled(kSmallest)));
  for (double& r : packing.radius) r *= factor;
  return packing;
}

}  // namespace ddem::packings
