#pragma once
// When the signals are sampled, and how well the invariant held.

#include <cstdint>
#include <optional>

#include "fem_reference/cases.h"
#include "fem_reference/kernel/leapfrog.h"

namespace ddem::fem {

/// Steps of `time_step` that a case asks for, at least one. Throws CaseError if they, or the signals of `values`
/// numbers a sample, are more than can be held.
std::uint64_t count_steps(const StripCase& strip, double time_step, std::size_t values);

/// Largest relative change of the leapfrog's invariant at a few times of the run, from `first_step` on.
class EnergyAudit {
 public:
  EnergyAudit(std::uint64_t first_step, std::uint64_t steps);

  void watch(const Leapfrog& leapfrog);
  std::optional<double> drift() const;

 private:
  std::uint64_t next_, interval_, count_ = 0;
  double first_ = 0.0, largest_change_ = 0.0;
};

}  // namespace ddem::fem
