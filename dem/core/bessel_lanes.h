#pragma once
// The recurrences of time_filter.cc for several times side by side, compiled once per instruction set.

#include <cstddef>

namespace ddem {

inline constexpr std::size_t bessel_lanes = 8;

enum class BesselSeries { released, struck, driven };

struct BesselTimes {
  double two_over_z[bessel_lanes] = {};
  std::size_t order[bessel_lanes] = {};  ///< from which Miller's recurrence starts; 0: a lane without a time
  double two_alpha = 0.0;                ///< of the drive
  std::size_t count = 0;                 ///< of the coefficients sought
};

/// Fills c times coefficient k of lane l into out[k * bessel_lanes + l], and c into `scale`. Coefficients beyond a lane's order
/// stay as they are.
using BesselFill = void (*)(BesselSeries series, const BesselTimes& times, double* out, double* scale);

}  // namespace ddem
