#pragma once
// Random packings of discs at the jamming point: dense, without voids, and without a lattice.

#include <cstdint>

#include "dem/core/packing.h"

namespace ddem::packings {

struct RandomSpec {
  double length = 0.0, width = 0.0;  ///< m: the periods in x and y, met exactly
  int discs = 0;
  std::uint64_t seed = 1;
  double radius_ratio = 1.67;  ///< largest over smallest radius, 1 to 10; radii are uniform between them
};

/// How well a packing is jammed.
struct JammingReport {
  double porosity = 0.0;          ///< 1 - area of the discs / area of the cell
  double mean_radius = 0.0;       ///< m
  double largest_overlap = 0.0;   ///< in mean radii
  double unbalanced_force = 0.0;  ///< largest net force on a disc over the mean contact force
  int contacts = 0;               ///< pairs that press on each other
  int rattlers = 0;               ///< discs that no contacts hold: fewer than three, peeled
  int iterations = 0;             ///< of the minimiser, in all
};

/// A jammed packing of frictionless discs, periodic in x and y, reproducible to the bit from its spec on
/// every machine: largest overlap at most 8e-4 mean radii, net force on a disc at most 1e-4 of the mean
/// contact force. The radii follow from the porosity at which the discs jam (0.157 +- 0.001 at ratio 1.67).
/// Discs are numbered from left to right.
///
/// Throws std::invalid_argument on an impossible spec (among others: a cell so narrow that a pair of discs
/// could touch through two images, more than 1e5 discs), std::runtime_error when no jammed packing in force
/// balance was found within 1e6 iterations of the minimiser.
Packing random_jammed(const RandomSpec& spec, JammingReport* report = nullptr);

}  // namespace ddem::packings
