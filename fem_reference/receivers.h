#pragma once
// Values at the receivers of a state of the strip.

#include <cstddef>
#include <span>
#include <vector>

#include "fem_reference/strip_model.h"

namespace ddem::fem {

/// Numbers that one state gives: ux, uy of each point, then of each section.
inline std::size_t receiver_values(const StripModel& model) {
  return 2 * (model.points.size() + model.sections.size());
}

/// Appends them to `out`.
void evaluate_receivers(const StripModel& model, std::span<const double> u, std::vector<double>& out);

}  // namespace ddem::fem
