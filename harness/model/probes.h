#pragma once
// Where signals are recorded, and which pairs of probes give a wave speed.

#include <string>
#include <vector>

#include "dem/simulation/simulation.h"
#include "harness/scene/scene.h"

namespace ddem::harness {

/// One recorded signal: a disc, or the mean over the discs of a cross-section.
struct Probe {
  std::string name;  ///< "disc12", "section3"; the columns of the signals file are name_ux, name_uy, name_theta
  double x = 0.0, y = 0.0;  ///< m, from the origin of the packing; mean over the section's discs
  Receiver receiver;
};

struct ProbePair {
  int from = 0, to = 0;  ///< indices of probes
  double distance = 0.0;  ///< along x, m
};

struct ProbeLayout {
  std::vector<Probe> probes;  ///< names differ: a disc that pairs share, or that is asked for twice, has one
  std::vector<ProbePair> pairs;
};

/// The scene's probes. `pairs = n` lays pairs on n rows, equally spaced over the width: from the disc nearest to a
/// quarter of the length to the disc nearest to it by 0.40, 0.35, 0.45, 0.375, 0.425 ... of the length further on, so
/// that distances differ. With `section = true` the same positions along x are cross-sections two mean diameters wide.
/// Throws InputError if a probe lies outside the assembly or a disc does not exist.
ProbeLayout lay_probes(const Scene& scene, const ddem::Assembly& assembly);

/// The same pairs on a strip without discs: at the wanted places exactly, from the lower left corner (0, 0).
ProbeLayout nominal_pairs(const ProbePairs& spec, double length, double width);

}  // namespace ddem::harness
