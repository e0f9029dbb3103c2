#pragma once
// The time loops: leapfrog states as the receivers see them, or filtered to be exact in time.

#include "fem_reference/run_case.h"

namespace ddem::fem {

/// What a case has become when time starts. `result.critical_time_step` is known.
struct StripProblem {
  const StripCase& strip;
  const StripModel& model;
  const ElasticOperator& stiffness;
  const std::vector<double>& inverse_mass;
};

/// Samples are states: second order in the step.
void march_verlet(const StripProblem& problem, CaseResult& result);

/// Samples are filtered from the states of a march with the largest stable step: the error is that of space alone.
void march_exact(const StripProblem& problem, CaseResult& result);

}  // namespace ddem::fem
