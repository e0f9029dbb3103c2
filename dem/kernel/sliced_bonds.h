#pragma once
// Bonds laid out for the gather loop: sliced ELLPACK. Eight successive discs make a slice; row r of a slice holds the
// r-th bond of each of its discs, so that one SIMD lane is one disc and every disc sums its own bonds in a fixed order
// (the same bits for any number of threads). A bond is stored twice, once from either end, with its normal turned.
// A disc with fewer bonds than its slice has rows is filled up with bonds to itself without an arm: they give no force.
// Where all discs touch, as on a lattice, arms are radii and are not kept; a bond to itself then has no normal.
//
// The arms of a bond, a_i = r_i L / (r_i + r_j), differ from the radii by the same factor s = L / (r_i + r_j) at both ends.
// The solver therefore keeps rotations and strains times the radius, r theta and r eps, and of the arms s alone.

#include <cstdint>
#include <vector>

#include "dem/core/bonds.h"
#include "dem/core/packing.h"
#include "dem/kernel/aligned.h"

namespace ddem {

constexpr int kLanes = 8;

struct SlicedBonds {
  int slices = 0;
  std::vector<std::int32_t> row_begin;     ///< slices + 1: first row of each slice
  AlignedVector<std::int32_t> neighbour;   ///< rows * kLanes, index of the other disc
  AlignedVector<double> nx, ny;            ///< unit normal towards the neighbour
  AlignedVector<double> stretch;           ///< s = L / (r_i + r_j); empty where all are 1
  AlignedVector<double> length;            ///< L, m; empty unless asked for
  AlignedVector<double> stiffness;         ///< k_n, N/m; empty where all bonds have the same

  std::size_t rows() const { return neighbour.size() / kLanes; }
  /// How many slices away the farthest neighbour of a disc is.
  int reach() const;
};

/// `position[d]` is the place of disc d in the solver's order; `stiffness` one value a bond, or empty. With neither
/// stiffnesses nor lengths, arms that are radii are left out.
SlicedBonds slice_bonds(const Bonds& bonds, const std::vector<int>& position, const std::vector<double>& stiffness, bool lengths);

/// Of every stored half-bond the one that the same bond has at its other end; what fills up a row is its own.
AlignedVector<std::int32_t> other_ends(const Bonds& bonds, const std::vector<int>& position, const SlicedBonds& sliced);

/// An order of the discs in which neighbours are near in memory, bands across the strip's short side, and discs of a slice
/// have about as many bonds.
/// Returns position[d].
std::vector<int> locality_order(const Packing& packing, const Bonds& bonds);

}  // namespace ddem
