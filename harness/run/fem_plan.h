#pragma once
// The continuum model of a scene: the strip between the discs that the edge conditions act on, with the same load and
// receivers at the places of the probes.

#include "harness/run/fem_run.h"

namespace ddem::harness {

struct FemPlan {
  FemCase fem;
  ProbeLayout layout;
  WaveContext context;
  bool sections = false;  ///< probes are cross-sections, not points
};

/// `moduli` may be left out where [continuum] gives E, nu and density; then the packing is not built either, and probes
/// lie at their nominal places. The strip reaches from the mean x of the left edge's discs to that of the right edge's; a driven edge
/// between periodic ones stands where the static displacement of the discs inside places it.
/// Throws InputError for a load that has no continuum counterpart (state files) and for missing material.
/// `assembly`: the scene's, where the caller has it and gives the moduli, too.
FemPlan plan_fem(const Scene& scene, const std::optional<SceneModuli>& moduli, const ddem::Assembly* assembly = nullptr);

/// Bytes that ddem-fem takes at most at a time: of elements whose number is known, and of signals of so many samples as there are
/// at least.
double memory_of_elements(const FemCase& fem);
double memory_of_signals(const FemCase& fem);

/// Throws InputError where the continuum would be exact in time, which snapshots of all nodes (FemCase::snapshots) are not.
void check_snapshots(const Scene& scene);

/// Whether [continuum] leaves nothing to the discs, so that plan_fem needs no moduli.
bool continuum_stands_alone(const Scene& scene);
/// Of one that does not: whether the static moduli of its assembly have to be known.
bool needs_moduli(const Scene& scene);

/// The speeds of a run's signals; the plan has pairs of probes.
WaveMeasurement measure_fem(const FemPlan& plan, const FemResult& result, Wave wave);

/// The signals of the receivers that belong to the plan's probes: the component of the wave.
const std::vector<std::vector<double>>& receiver_signals(const FemPlan& plan, const FemResult& result, Wave wave);

}  // namespace ddem::harness
