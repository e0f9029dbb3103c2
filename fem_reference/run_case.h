#pragma once
// One case from its initial state to its signals.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fem_reference/cases.h"
#include "fem_reference/strip_model.h"

namespace ddem::fem {

struct CaseResult {
  std::vector<double> time;                          ///< n, s
  std::vector<double> points;                        ///< n x points x 2 (ux, uy), m
  std::vector<double> sections;                      ///< n x sections x 2, m
  std::uint64_t dofs = 0;                            ///< two a node, fixed ones included, periodic ones once
  double critical_time_step = 0.0, time_step = 0.0;  ///< s
  std::uint64_t steps = 0;                           ///< done
  double solve_seconds = 0.0;                        ///< critical step and time loop
  /// Largest relative change of the leapfrog's invariant; of a driven case from the end of the drive on. Not
  /// there if fewer than two energies could be compared.
  std::optional<double> energy_drift;
  std::string status = "ok";  ///< or "unstable: step N"; the signals then end before it

  bool ok() const { return status == "ok"; }
};

/// Nodal displacement at t = 0, interleaved, of the kernel's vector_size(). The profiles depend on x alone,
/// hence nodes that a periodic boundary merges agree. Zero at fixed degrees of freedom.
std::vector<double> initial_displacement(const StripCase& strip, const StripModel& model);

/// Throws CaseError if the case asks for more steps or samples than can be held, std::runtime_error if the
/// critical step cannot be found.
CaseResult run_case(const StripCase& strip, const StripModel& model);

}  // namespace ddem::fem
