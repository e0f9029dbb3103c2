#pragma once
// Velocities by one protocol, and the elastic constants that follow.

#include "harness/studies/strip/strip_results.h"
#include "reports/table.h"

namespace ddem::harness {

/// One row a model and ratio: each wave's measured velocity, how far it is from the static one, and what follows.
reports::Table speed_table(const StripResults& results, Protocol protocol);

}  // namespace ddem::harness
