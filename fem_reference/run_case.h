#pragma once
// One case from its initial state to its signals.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dem/core/team.h"
#include "fem_reference/cases.h"
#include "fem_reference/fields.h"
#include "fem_reference/strip_model.h"

namespace ddem::fem {

struct CaseResult {
  std::vector<double> time;     ///< of the n samples, s
  std::vector<double> signals;  ///< n x receiver_values(model), m
  Fields fields;                ///< empty without snapshots
  std::uint64_t dofs = 0;       ///< two a node, fixed ones included, periodic ones once
  std::uint64_t elements = 0;
  double critical_time_step = 0.0, time_step = 0.0;  ///< s
  double sample_interval = 0.0;                      ///< s
  std::uint64_t steps = 0;                           ///< done
  double solve_seconds = 0.0;                        ///< critical step, time loop, receivers
  /// Largest relative change of the leapfrog's invariant; of a driven case with integrator verlet from the end of the
  /// drive on. Not there if fewer than two energies could be compared.
  std::optional<double> energy_drift;
  std::string status = "ok";  ///< or "unstable: step N"; the signals then end before it

  bool ok() const { return status == "ok"; }
};

/// Throws CaseError if the case asks for more steps or samples than can be held, std::runtime_error if the
/// critical step cannot be found.
/// The same bits for any number of threads in `team`.
CaseResult run_case(const StripCase& strip, const StripModel& model, Team& team);

}  // namespace ddem::fem
