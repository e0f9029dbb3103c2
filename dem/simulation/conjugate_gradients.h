#pragma once
// Conjugate gradients for the implicit particle strains, (1 + T) eps = f with T = (V C)^-1 S K G, in the inner product of
// V C (that is, preconditioned with V C), starting from the strains of the step before. The bond loops are kernels; this
// class owns the vectors, sums the inner products (one share a disc, always in the same order, so that the number of
// threads does not matter) and says which kernel is due.
//
// Slower than the polynomial on every packing and softness measured, and the energy is conserved to the tolerance only:
// here as an independent check of the polynomial, and because it applies the operator as it stands at the step, which is
// what contacts that open and close need.

#include <optional>

#include "dem/core/material.h"
#include "dem/kernel/aligned.h"
#include "dem/kernel/step_data.h"
#include "dem/simulation/stage.h"

namespace ddem {

/// Why the strains of a step could not be found.
struct StrainBreakdown {
  enum class Cause { not_converged, indefinite } cause;
  int place = 0;  ///< of the disc with the largest residual, in the solver's order
};

class ConjugateGradients {
 public:
  /// For `places` discs; `compliance` D r^2 / V_p. Stops when the residual, in the norm of V C, is below `tolerance` times
  /// the strains that the forces at hand ask for.
  ConjugateGradients(std::size_t places, const Compliance& compliance, double tolerance);

  void bind(StepData& data);

  /// What follows after `finished`: motion once the strains are found, or after a breakdown. Sets the step lengths in
  /// `data`.
  Stage next(Stage finished, StepData& data);

  const std::optional<StrainBreakdown>& breakdown() const { return breakdown_; }

 private:
  Stage start();
  Stage after_advance(StepData& data);
  Stage fail(StrainBreakdown::Cause cause);

  AlignedVector<double> product_, scale_;
  AlignedVector<double> direction_, applied_;  // kQuad a disc
  Compliance compliance_;
  double tolerance_ = 0.0;
  double square_ = 0.0, target_ = 0.0;  // <r, r>, and what it must fall to
  int iterations_ = 0;  // of this step
  std::optional<StrainBreakdown> breakdown_;
};

}  // namespace ddem
