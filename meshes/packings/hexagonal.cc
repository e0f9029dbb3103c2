#include "meshes/packings/hexagonal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace ddem::packings {
namespace {

constexpr double kWorstFit = 1.3;  // largest factor between the shape asked for and the one that comes out
constexpr double kMostOfALattice = 1e8;
constexpr double kSqrt3 = std::numbers::sqrt3;

struct Grid {
  int columns = 0, rows = 0;
};

/// Size of the smallest box around the discs, in radii.
struct Box {
  double length, width;
};

Box box_of(const Grid& grid, CloseRows direction) {
  const auto touching = [](int in_line, int lines) { return 2.0 * in_line + (lines > 1 ? 1.0 : 0.0); };
  const auto stacked = [](int lines) { return 2.0 + (lines - 1) * kSqrt3; };
  if (direction == CloseRows::along_x) return {touching(grid.columns, grid.rows), stacked(grid.rows)};
  return {stacked(grid.columns), touching(grid.rows, grid.columns)};
}

bool closes(const Grid& grid, const HexagonalSpec& spec) {
  return spec.close_packed == CloseRows::along_x ? !spec.periodic_y || grid.rows % 2 == 0
                                                 : !spec.periodic_x || grid.columns % 2 == 0;
}

/// Factor >= 1 between the shape of the grid's box and length : width.
double misfit(const Grid& grid, const HexagonalSpec& spec) {
  const Box box = box_of(grid, spec.close_packed);
  const double ratio = (box.length / box.width) / (spec.length / spec.width);
  return std::max(ratio, 1.0 / ratio);
}

std::optional<Grid> best_factorisation(int discs, const HexagonalSpec& spec) {
  std::optional<Grid> best;
  const auto consider = [&](const Grid& grid) {
    if (!closes(grid, spec) || misfit(grid, spec) > kWorstFit) return;
    if (!best || misfit(grid, spec) < misfit(*best, spec)) best = grid;
  };
  for (int factor = 1; factor <= discs / factor; ++factor) {
    if (discs % factor != 0) continue;
    consider({discs / factor, factor});
    consider({factor, discs / factor});
  }
  return best;
}

/// The number of discs nearest to the one asked for that can be arranged; 0 when there is none nearby.
std::pair<int, Grid> nearest_count(const HexagonalSpec& spec) {
  for (int away = 1; away <= 1000; ++away)
    for (const int discs : {spec.discs - away, spec.discs + away})
      if (discs > 0)
        if (const auto grid = best_factorisation(discs, spec)) return {discs, *grid};
  return {0, {}};
}

Grid grid_of_discs(const HexagonalSpec& spec) {
  if (const auto grid = best_factorisation(spec.discs, spec)) return *grid;
  std::string remedy = "give columns, rows and radius instead";
  if (const auto [discs, grid] = nearest_count(spec); discs > 0)
    remedy = fmt::format("{} discs would do ({} columns x {} rows), or {}", discs, grid.columns, grid.rows,
                         remedy);
  throw std::invalid_argument(
      fmt::format("{} discs fill no whole rows of a hexagonal packing of about {:.6g} m x {:.6g} m{}: {}",
                  spec.discs, spec.length, spec.width,
                  spec.periodic_x || spec.periodic_y ? " that closes on its periods" : "", remedy));
}

void check_given(const HexagonalSpec& spec) {
  const auto check = [](double value, const char* name) {
    if (!std::isfinite(value) || value < 0.0)
      throw std::invalid_argument(fmt::format("{} must be positive and finite, but is {}", name, value));
  };
  check(spec.columns, "columns");
  check(spec.rows, "rows");
  check(spec.radius, "radius");
  check(spec.length, "length");
  check(spec.width, "width");
  check(spec.discs, "discs");
  if (std::max(static_cast<double>(spec.columns) * spec.rows, static_cast<double>(spec.discs)) > kMostOfALattice)
    throw std::invalid_argument(fmt::format("more than {:g} discs are not possible", kMostOfALattice));

  const int lattice = (spec.columns > 0) + (spec.rows > 0) + (spec.radius > 0.0);
  const int rectangle = (spec.length > 0.0) + (spec.width > 0.0) + (spec.discs > 0);
  if (!(lattice == 3 && rectangle == 0) && !(lattice == 0 && rectangle == 3))
    throw std::invalid_argument(
        "a hexagonal packing needs columns, rows and radius, or else length, width and discs, all positive");
}

void check_closes(const HexagonalSpec& spec, const Grid& grid) {
  if (closes(grid, spec)) return;
  const bool along_x = spec.close_packed == CloseRows::along_x;
  const int lines = along_x ? grid.rows : grid.columns;
  throw std::invalid_argument(
      fmt::format("{} must be even where the packing is periodic in {}, since every other one is shifted, "
                  "but there are {}: "
                  "take {}",
                  along_x ? "rows" : "columns", along_x ? "y" : "x", lines,
                  lines < 5 ? std::string("4") : fmt::format("{} or {}", lines - 1, lines + 1)));
}

}  // namespace

Packing hexagonal(const HexagonalSpec& spec) {
  check_given(spec);
  const Grid grid = spec.discs > 0 ? grid_of_discs(spec) : Grid{spec.columns, spec.rows};
  check_closes(spec, grid);
  const double r = spec.discs > 0 ? spec.length / box_of(grid, spec.close_packed).length : spec.radius;

  const bool along_x = spec.close_packed == CloseRows::along_x;
  Packing packing;
  packing.length = grid.columns * (along_x ? 2.0 : kSqrt3) * r;
  packing.width = grid.rows * (along_x ? kSqrt3 : 2.0) * r;
  packing.period = {spec.periodic_x ? packing.length : 0.0, spec.periodic_y ? packing.width : 0.0};
  const auto in_line = [r](int k, int line) { return r + 2.0 * r * k + (line % 2 == 1 ? r : 0.0); };
  const auto of_line = [r](int line) { return r + line * kSqrt3 * r; };
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      packing.x.push_back(along_x ? in_line(column, row) : of_line(column));
      packing.y.push_back(along_x ? of_line(row) : in_line(row, column));
    }
  packing.radius.assign(packing.x.size(), r);
  return packing;
}

}  // namespace ddem::packings
