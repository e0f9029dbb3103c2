#pragma once
// How a sample too large to be jammed as a whole is put together from copies of one periodic cell.

#include <cstdint>

namespace ddem::packings {

struct Tiling {
  int nx = 1, ny = 1;  ///< copies along x and y
  int discs = 0;       ///< of a cell
};

/// Samples of up to so many discs are jammed as a whole.
inline constexpr std::int64_t kLargestJammed = 20000;

/// The rule: one cell up to kLargestJammed discs. Above, nx x ny = discs/cell cells of 1000 to 4000 discs each, as many
/// in a cell as the number of discs allows, where a cell (length/nx x width/ny) is at most four times as long as wide or
/// the reverse. Nothing is rounded: number of discs, length and width are those asked for.
///
/// A tiled sample repeats itself: its waves see a periodic medium (with stop bands at wavelengths of two cells and less),
/// and its statistics are those of one cell.
///
/// Throws std::invalid_argument where no such cells give the number of discs (a prime number, say): it names the nearest
/// number that can be had.
Tiling tiling_of(std::int64_t discs, double length, double width);

}  // namespace ddem::packings
