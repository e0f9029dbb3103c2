#pragma once
// How the radii of a packing's discs are distributed. They are quantiles, not samples: every seed has the same ones, in another order.

#include <vector>

namespace ddem::packings {

/// Shares by mass of the discs that are smaller (of discs of one density and thickness: by area): linear between the points, from 0
/// at the smallest radius to 1 at the largest.
struct SieveCurve {
  std::vector<double> radius, passing;  ///< any unit of length, as radii are scaled; increasing, and not decreasing

  bool operator==(const SieveCurve&) const = default;
};

struct Grading {
  enum class Law {
    uniform,     ///< by number, between the smallest radius and the largest
    log_normal,  ///< by number: the logarithm is normal, the smallest and largest radius are two standard deviations off its mean
    sieve        ///< by mass
  };
  Law law = Law::uniform;
  SieveCurve sieve = {};

  bool operator==(const Grading&) const = default;
};

/// Ascending, in units of the smallest radius of the law. `radius_ratio`, largest over smallest, is not that of a sieve curve, which has
/// its own. Throws std::invalid_argument for a curve that is none.
std::vector<double> graded_radii(const Grading& grading, double radius_ratio, int discs);

}  // namespace ddem::packings
