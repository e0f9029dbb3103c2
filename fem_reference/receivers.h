#pragma once
// Values at the receivers of a state of the strip.

#include <cstddef>
#include <span>
#include <vector>

#include "fem_reference/kernel/elastic_operator.h"
#include "fem_reference/strip_model.h"

namespace ddem::fem {

/// Each thread of a team reads the receivers among the nodes that it moves: displacements that pass from core to core in
/// every step cost more than moving them.
class ReceiverReader {
 public:
  /// Keeps references to the model and to the team of `stiffness`.
  ReceiverReader(const StripModel& model, const ElasticOperator& stiffness);

  /// Numbers that one state gives: ux, uy of each point, then of each section.
  std::size_t values() const { return 2 * receivers_.size(); }

  /// All of them from `u`, to `row` of values() entries.
  void evaluate(std::span<const double> u, double* row) const;

  /// Those of one thread, in Leapfrog::step(); evaluate_rest() then gives what no thread has for itself, and what touches
  /// the left edge, whose motion may be prescribed after the step.
  void evaluate_share(int thread, std::span<const double> u, double* row) const { evaluate(shares_[static_cast<std::size_t>(thread)], u, row); }
  void evaluate_rest(std::span<const double> u, double* row) const { evaluate(shares_.back(), u, row); }

 private:
  void evaluate(const std::vector<std::size_t>& which, std::span<const double> u, double* row) const;

  std::vector<const NodeWeights*> receivers_;
  std::vector<std::vector<std::size_t>> shares_;  ///< receivers of each thread, then the rest
};

}  // namespace ddem::fem
