#pragma once
// The random packing of a scene: jammed as a whole, or tiled from a jammed cell.

#include "dem/core/packing.h"
#include "harness/scene/scene.h"
#include "meshes/packings/flat_walls.h"
#include "meshes/packings/tiling.h"

namespace ddem::harness {

/// walls = "flat" are walls in the directions in which the assembly is not periodic: four of them for a strip with free
/// edges, those at its two ends for top_bottom = "periodic". With walls = "periodic" there are none.
packings::FlatWalls walls_of(const RandomPacking& packing, Periodicity periodic);

/// See tiling_of(). Throws std::invalid_argument for flat walls around more discs than are jammed as a whole.
packings::Tiling tiling_of(const RandomPacking& packing, Periodicity periodic);

/// What is jammed: the whole packing, or the cell that random_packing() repeats; its radii scaled to the porosity that is asked for.
/// Throws as random_packing().
Packing jammed_cell(const RandomPacking& packing, Periodicity periodic);

/// The packing, periodic where it has no walls, from memory or the user's cache where it was jammed before.
/// Throws std::invalid_argument and std::runtime_error as random_jammed(), packings::PorosityOutOfReach, and InputError for a sieve
/// curve that is none.
Packing random_packing(const RandomPacking& packing, Periodicity periodic);

}  // namespace ddem::harness
