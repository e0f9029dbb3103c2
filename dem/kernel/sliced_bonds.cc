#include "dem/kernel/sliced_bonds.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

namespace ddem {
namespace {

/// Rows of the slices, from the bonds of every place.
void lay_rows(const std::vector<std::int32_t>& bonds_at, SlicedBonds& s) {
  s.row_begin.assign(static_cast<std::size_t>(s.slices) + 1, 0);
  for (int slice = 0; slice < s.slices; ++slice) {
    const auto first = bonds_at.begin() + static_cast<std::ptrdiff_t>(slice) * kLanes;
    s.row_begin[slice + 1] = s.row_begin[slice] + *std::max_element(first, first + kLanes);
  }
}

/// Discs with as many bonds share slices, so that fewer rows are filled up: of so many successive discs, the most bonded
/// first.
void group_by_bonds(const Bonds& bonds, std::vector<int>& order) {
  constexpr std::size_t kWindow = 128;
  std::vector<int> count(order.size(), 0);
  for (std::size_t c = 0; c < bonds.size(); ++c) ++count[bonds.i[c]], ++count[bonds.j[c]];
  for (std::size_t first = 0; first < order.size(); first += kWindow) {
    const auto begin = order.begin() + static_cast<std::ptrdiff_t>(first);
    std::stable_sort(begin, begin + static_cast<std::ptrdiff_t>(std::min(kWindow, order.size() - first)),
                     [&](int a, int b) { return count[a] > count[b]; });
  }
}

bool all_touch(const Bonds& b) {
  return std::all_of(b.stretch.begin(), b.stretch.end(), [](double s) { return s == 1.0; });
}

/// Every place bonded to itself, without an arm.
void fill_up(bool stiffness, bool lengths, bool stretch, SlicedBonds& s) {
  const std::size_t half_bonds = static_cast<std::size_t>(s.row_begin.back()) * kLanes;
  s.neighbour.resize(half_bonds);
  for (int slice = 0; slice < s.slices; ++slice) {
    for (std::int32_t k = s.row_begin[slice] * kLanes; k < s.row_begin[slice + 1] * kLanes; ++k)
      s.neighbour[k] = slice * kLanes + k % kLanes;
  }
  s.nx.assign(half_bonds, lengths ? 1.0 : 0.0);  // a length needs a direction
  s.ny.assign(half_bonds, 0.0);
  if (stretch) s.stretch.assign(half_bonds, 0.0);
  if (lengths) s.length.assign(half_bonds, 1.0);
  if (stiffness) s.stiffness.assign(half_bonds, 0.0);
}

}  // namespace

SlicedBonds slice_bonds(const Bonds& b, const std::vector<int>& position,
                        const std::vector<double>& stiffness, bool lengths) {
  SlicedBonds s;
  s.slices = (static_cast<int>(position.size()) + kLanes - 1) / kLanes;
  std::vector<std::int32_t> bonds_at(static_cast<std::size_t>(s.slices) * kLanes, 0);
  for (std::size_t c = 0; c < b.size(); ++c) ++bonds_at[position[b.i[c]]], ++bonds_at[position[b.j[c]]];
  lay_rows(bonds_at, s);
  const bool touching = stiffness.empty() && !lengths && all_touch(b);
  fill_up(!stiffness.empty(), lengths, !touching, s);
  std::fill(bonds_at.begin(), bonds_at.end(), 0);
  const auto put = [&](std::size_t c, int at, int other, double sign) {
    const std::size_t row = static_cast<std::size_t>(s.row_begin[at / kLanes] + bonds_at[at]++),
                      k = row * kLanes + static_cast<std::size_t>(at % kLanes);
    s.neighbour[k] = other;
    s.nx[k] = sign * b.nx[c], s.ny[k] = sign * b.ny[c];
    if (!touching) s.stretch[k] = b.stretch[c];
    if (lengths) s.length[k] = b.length[c];
    if (!stiffness.empty()) s.stiffness[k] = stiffness[c];
  };
  for (std::size_t c = 0; c < b.size(); ++c) {
    const int i = position[b.i[c]], j = position[b.j[c]];
    put(c, i, j, 1.0);
    put(c, j, i, -1.0);
  }
  return s;
}

AlignedVector<std::int32_t> other_ends(const Bonds& b, const std::vector<int>& position, const SlicedBonds& s) {
  AlignedVector<std::int32_t> other(s.neighbour.size());
  std::iota(other.begin(), other.end(), 0);
  std::vector<std::int32_t> bonds_at(static_cast<std::size_t>(s.slices) * kLanes, 0);
  const auto next = [&](int at) { return (s.row_begin[at / kLanes] + bonds_at[at]++) * kLanes + at % kLanes; };  // as they were put
  for (std::size_t c = 0; c < b.size(); ++c) {
    const std::int32_t i = next(position[b.i[c]]), j = next(position[b.j[c]]);
    other[i] = j, other[j] = i;
  }
  return other;
}

int SlicedBonds::reach() const {
  int most = 0;
  for (int slice = 0; slice < slices; ++slice) {
    for (std::int32_t k = row_begin[slice] * kLanes; k < row_begin[slice + 1] * kLanes; ++k)
      most = std::max(most, std::abs(neighbour[k] / kLanes - slice));
  }
  return most;
}

std::vector<int> locality_order(const Packing& p, const Bonds& bonds) {
  const double band = 4.0 * mean_radius(p);
  std::vector<int> order(p.size());
  std::iota(order.begin(), order.end(), 0);
  const bool along_x = p.length >= p.width;
  const std::vector<double>& major = along_x ? p.x : p.y;
  const std::vector<double>& minor = along_x ? p.y : p.x;
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    const double band_a = std::floor(major[a] / band), band_b = std::floor(major[b] / band);
    return band_a != band_b ? band_a < band_b : minor[a] < minor[b];
  });
  group_by_bonds(bonds, order);
  std::vector<int> position(p.size());
  for (std::size_t k = 0; k < order.size(); ++k) position[order[k]] = static_cast<int>(k);
  return position;
}

}  // namespace ddem
