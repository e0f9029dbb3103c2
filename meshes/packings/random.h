#pragma once
// Random packings of discs at the jamming point: dense, and without voids.

#include <cstdint>
#include <functional>

#include "dem/core/packing.h"
#include "meshes/packings/flat_walls.h"
#include "meshes/packings/grading.h"

namespace ddem::packings {

struct RandomSpec {
  double length = 0.0, width = 0.0;  ///< m: periods, or distances of walls
  int discs = 0;
  std::uint64_t seed = 1;
  double radius_ratio = 1.67;  ///< largest over smallest radius, 1 to 10
  FlatWalls walls = {};        ///< where not periodic
  Grading grading = {};

  bool operator==(const RandomSpec&) const = default;
};

/// A jammed packing of frictionless discs, periodic or between flat walls, reproducible to the bit from its spec on
/// every machine: largest overlap (of discs, and with walls) at most 8e-4 mean radii, net force on a disc at most 1e-4 of
/// the mean contact force. Length and width are met exactly: they are the periods, or the distances of the walls. The
/// radii follow from the porosity at which the discs jam (0.157 +- 0.001 at ratio 1.67, periodic).
/// Discs are numbered from left to right. Equal discs (ratio 1) crystallise in part: see statistics_of().
///
/// Throws std::invalid_argument on an impossible spec (among others: a cell so narrow that a pair of discs
/// could touch through two images, more than 1e5 discs), std::runtime_error when no jammed packing in force
/// balance was found within 1e6 iterations of the minimiser.
/// Many discs take minutes: `progress` is told now and then how far the largest overlap has come down, in mean radii.
Packing random_jammed(const RandomSpec& spec, const std::function<void(double largest_overlap)>& progress = {});

/// The largest overlap in the end, mean radii.
inline constexpr double kJammedOverlap = 8e-4;

/// Whether a packing of unknown origin can be random_jammed(spec): numbers are finite, centres inside and in order, radii
/// those of the spec, overlaps and forces what is promised above, and discs near where the seed puts them before they are
/// jammed (not for equal discs, which cannot be told apart). A thousandth of the time that jamming takes. A disc that
/// touches no other may still have been moved within its cage.
bool can_be_jammed_from(const Packing& packing, const RandomSpec& spec);

/// The bits of one small packing, which a test compares. Whatever changes the packing of a spec changes this number too:
/// part of the name under which a packing may be stored.
inline constexpr std::uint64_t kJammingBits = 17593074311740711017ULL;

}  // namespace ddem::packings
