#pragma once
// Equal discs that touch on a hexagonal lattice: theory section 2's closed forms hold for its infinite form.

#include "dem/core/packing.h"

namespace ddem::packings {

/// Direction of the lines of touching discs.
enum class CloseRows { along_x, along_y };

/// Either columns, rows and radius, or length, width and discs; the others stay 0. `columns` are counted
/// along x and `rows` along y in both orientations.
struct HexagonalSpec {
  CloseRows close_packed = CloseRows::along_x;
  int columns = 0, rows = 0;
  double radius = 0.0;               ///< m
  double length = 0.0, width = 0.0;  ///< m, of the smallest box around the discs
  int discs = 0;
  bool periodic_x = false, periodic_y = false;
};

/// Disc (row, column) has the number row * columns + column, the first centre is (r, r).
///   along_x: row k lies at y = r + k sqrt(3) r, odd rows are shifted by r in x;
///   along_y: column k lies at x = r + k sqrt(3) r, odd columns are shifted by r in y.
/// The packing's length and width are nominal: columns 2r and rows sqrt(3) r (along_x), columns sqrt(3) r and
/// rows 2r (along_y), so that the discs fill pi/(2 sqrt(3)) of their area exactly. They are the periods as
/// well, where periodic; the lattice closes only on an even number of rows (along_x, periodic in y) or of
/// columns (along_y, periodic in x).
///
/// From length, width and discs: of all columns x rows = discs (even where they must be) the one whose shape
/// is nearest to length : width, within a factor 1.3. The radius then makes the box around the discs,
/// half-shifted rows included, exactly `length` long: 682 discs in 16.5 mm x 2 mm become 62 x 11 discs of
/// 0.132 mm. The length is kept because wave paths are measured along it; the width comes out within the
/// same factor.
///
/// Throws std::invalid_argument, with the remedy, on anything missing, impossible or given in both ways.
Packing hexagonal(const HexagonalSpec& spec);

}  // namespace ddem::packings
