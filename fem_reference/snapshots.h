#pragma once
// Takes the fields of all nodes from a leapfrog while it runs.

#include <cstdint>

#include "fem_reference/cases.h"
#include "fem_reference/fields.h"
#include "fem_reference/kernel/leapfrog.h"
#include "fem_reference/kernel/material.h"
#include "fem_reference/strip_model.h"

namespace ddem::fem {

/// Snapshot k of the case's n, k = 1 .. n, comes after the first step that is at or beyond k/n of all, one a step at most:
/// its time is that of the step; displacement, velocity and what follows from them are second order in the step as the leapfrog is.
class SnapshotRecorder {
 public:
  /// Fills `fields`; keeps references to all three. Throws CaseError if they are more than can be held.
  SnapshotRecorder(const StripCase& strip, const StripModel& model, std::uint64_t steps, Fields& fields);

  /// After each step.
  void watch(const Leapfrog& leapfrog);

 private:
  const StripCase& strip_;
  const StripModel& model_;
  PlaneMaterial material_;
  std::uint64_t steps_;
  Fields& fields_;
};

}  // namespace ddem::fem
