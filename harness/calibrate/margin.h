#pragma once
// The largest stability margin among parameters with the same Poisson's ratio.

#include "harness/calibrate/search.h"

namespace ddem::harness {

/// From a point, along nu = const within the space, to the smallest spectral radius of K B: how strongly
/// strains answer strains, which bounds the lagged scheme and sets the cost of the implicit one. Sequential
/// quadratic programming (NLopt's SLSQP) with derivatives of nu from the static solve; the start itself where
/// that finds nothing better.
ModelPoint largest_margin(const StaticModel& model, const SearchSpace& space, const ModelPoint& start);

}  // namespace ddem::harness
