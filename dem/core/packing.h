#pragma once
// Where the discs are: centres and radii, structure of arrays, and the periods of the cell they live in.

#include <cstddef>
#include <vector>

namespace ddem {

/// Periods of the cell in metres; 0 means not periodic in that direction.
struct Period {
  double x = 0.0;
  double y = 0.0;
};

struct Packing {
  std::vector<double> x, y;    ///< centres, m
  std::vector<double> radius;  ///< m
  Period period;               ///< which images of a disc are its neighbours too
  /// Nominal size of the sample, m: length * width is the area that bulk density refers to.
  double length = 0.0, width = 0.0;

  std::size_t size() const { return x.size(); }
};

double mean_radius(const Packing& packing);

/// d minus its nearest multiple of `period` (a component of the vector to the nearest image).
inline double nearest_image(double d, double period) {
  if (period <= 0.0) return d;
  return d - period * static_cast<double>(static_cast<long long>(d / period + (d < 0 ? -0.5 : 0.5)));
}

}  // namespace ddem
