#pragma once
// How long and wide a packing is that comes without a size.
//
// The rectangle of the outermost discs is not it: its ends are rough, by half a disc spacing at each, and what lies beyond the
// last discs' half of a row belongs to no disc. What does not depend on the ends are the discs' area along a line through the
// inside and the share of the inside that the discs fill; length and width are those that give both. Of a lattice they are
// those of its rows and columns, whatever its ends look like. Of random strips cut from a periodic cell (300 and 682 discs)
// they are within 0.5 % of the cell's, the area within 0.3 %; of packings between flat walls, which leave voids beside them,
// the area is 2 % smaller than that between the walls.

#include <optional>
#include <span>

#include "dem/core/packing.h"

namespace ddem {

/// Sum of the weights per unit of the coordinate, away from both ends: each counts by a smooth window, so that rows at equal
/// distances d count as a continuum to exp(-pi n/2), n d the ramp at each end, at most a half of the whole. None where there
/// is no room for four of `spacing`, which is about d.
std::optional<double> density_along(std::span<const double> coordinate, std::span<const double> weight, double spacing);

/// Share of the discs in the polygon through the outermost centres, which a ball a little larger than a disc rolls over;
/// corners count by their angle. None where the centres enclose nothing, as those of a single row. Free edges only.
std::optional<double> enclosed_fraction(const Packing& packing);

struct Outline {
  double length = 0.0, width = 0.0;  ///< m
};

/// What is given stays; `packing` needs no length and width. Where the inside tells nothing, the extent of the discs.
Outline outline_of(const Packing& packing, std::optional<double> length, std::optional<double> width);

}  // namespace ddem
