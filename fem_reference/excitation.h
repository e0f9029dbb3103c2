#pragma once
// What moves the strip, and what holds it: state at t = 0, prescribed edges, masses of what is free.

#include <vector>

#include "dem/core/time_filter.h"
#include "fem_reference/cases.h"
#include "fem_reference/kernel/elastic_operator.h"
#include "fem_reference/strip_model.h"

namespace ddem::fem {

/// Entry of ux (longitudinal) or uy (shear) in a node's pair.
int component(Wave wave);

/// Inverse lumped mass of every degree of freedom, of the kernel's vector_size(): 0 where an edge is fixed or driven.
std::vector<double> inverse_mass(const StripCase& strip, const StripModel& model, const ElasticOperator& stiffness);

/// Nodal values of `pulse` (m or m/s), of the kernel's vector_size(), zero at fixed degrees of freedom. Standing waves
/// apart, profiles depend on x alone, hence nodes that a periodic boundary merges agree.
std::vector<double> initial_field(const StripCase& strip, const StripModel& model, const InitialPulse& pulse);

/// 1 at the degrees of freedom that the drive moves: times g(t) their displacement.
std::vector<double> driven_edge(const StripCase& strip, const StripModel& model, const ElasticOperator& stiffness);

/// The drive's motion over its amplitude.
Sin2 motion(const EdgeDrive& drive);

}  // namespace ddem::fem
