#include "harness/model/random_packing.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "dem/core/narrow.h"
#include "harness/model/packing_store.h"
#include "harness/model/valid_table.h"
#include "harness/scene/csv.h"
#include "harness/scene/limits.h"
#include "meshes/packings/porosity.h"
#include "meshes/packings/tile.h"

namespace ddem::harness {

static_assert(kJammedUnasked == packings::kLargestJammed);

packings::FlatWalls walls_of(const RandomPacking& packing, Periodicity periodic) {
  const bool flat = packing.walls == Walls::flat;
  return {flat && !periodic.x, flat && !periodic.y};
}

namespace {

/// The enumerators of a scene's gradings are those of the packings'.
packings::Grading grading_of(const RandomPacking& p) {
  packings::Grading grading{.law = static_cast<packings::Grading::Law>(p.grading)};
  if (p.grading != Grading::sieve) return grading;
  const Checked<SieveTable> curve = read_sieve_table(p.sieve);
  grading.sieve = {valid_table(curve).radius, valid_table(curve).passing};
  return grading;
}

}  // namespace

packings::Tiling tiling_of(const RandomPacking& p, Periodicity periodic) {
  if (p.cell == Cell::whole) return {1, 1, narrow<int>(p.discs, "assembly.discs")};
  const bool walled = walls_of(p, periodic) != packings::FlatWalls{};
  if (walled && p.discs > packings::kLargestJammed)
    throw std::invalid_argument(
        fmt::format("{} discs between flat walls would have to be jammed as a whole, which takes minutes above {}: say so by "
                    "cell = \"whole\", or take fewer discs, or walls = \"periodic\"",
                    p.discs, packings::kLargestJammed));
  return packings::tiling_of(p.discs, p.length, p.width);
}

Packing jammed_cell(const RandomPacking& p, Periodicity periodic) {
  const packings::Tiling tiling = tiling_of(p, periodic);
  const packings::FlatWalls walls = walls_of(p, periodic);
  Packing cell = stored_random_packing({.length = p.length / tiling.nx,
                                        .width = p.width / tiling.ny,
                                        .discs = tiling.discs,
                                        .seed = static_cast<std::uint64_t>(p.seed),
                                        .radius_ratio = p.radius_ratio,
                                        .walls = walls,
                                        .grading = grading_of(p)});
  return p.porosity ? packings::with_porosity(std::move(cell), *p.porosity, walls != packings::FlatWalls{}) : cell;
}

Packing random_packing(const RandomPacking& p, Periodicity periodic) {
  const packings::Tiling tiling = tiling_of(p, periodic);
  Packing packing = jammed_cell(p, periodic);
  if (tiling.nx == 1 && tiling.ny == 1) return packing;
  packing = packings::tile(packing, tiling.nx, tiling.ny);
  // As asked for, not nx times a rounded part of it.
  packing.length = packing.period.x = p.length;
  packing.width = packing.period.y = p.width;
  return packing;
}

}  // namespace ddem::harness
