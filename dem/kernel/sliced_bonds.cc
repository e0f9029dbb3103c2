#include "dem/kernel/sliced_bonds.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ddem {
namespace {

struct HalfBond {
  int other;
  double nx, ny, stretch, length, stiffness;
};

std::vector<std::vector<HalfBond>> half_bonds(const Bonds& b, const std::vector<int>& position,
                                              const std::vector<double>& stiffness) {
  std::vector<std::vector<HalfBond>> of_disc(position.size());
  for (std::size_t c = 0; c < b.size(); ++c) {
    const int i = position[b.i[c]], j = position[b.j[c]];
    const double k_n = stiffness.empty() ? 0.0 : stiffness[c];
    of_disc[i].push_back({j, b.nx[c], b.ny[c], b.stretch[c], b.length[c], k_n});
    of_disc[j].push_back({i, -b.nx[c], -b.ny[c], b.stretch[c], b.length[c], k_n});
  }
  return of_disc;
}

}  // namespace

SlicedBonds slice_bonds(const Bonds& bonds, const std::vector<int>& position, const std::vector<double>& stiffness, bool lengths) {
  const std::vector<std::vector<HalfBond>> of_disc = half_bonds(bonds, position, stiffness);
  const int discs = static_cast<int>(position.size());
  SlicedBonds s;
  s.slices = (discs + kLanes - 1) / kLanes;
  s.row_begin.push_back(0);
  for (int slice = 0; slice < s.slices; ++slice) {
    std::size_t rows = 0;
    for (int lane = 0; lane < kLanes; ++lane) {
      const int d = slice * kLanes + lane;
      if (d < discs) rows = std::max(rows, of_disc[d].size());
    }
    for (std::size_t row = 0; row < rows; ++row) {
      for (int lane = 0; lane < kLanes; ++lane) {
        const int d = slice * kLanes + lane;
        const bool real = d < discs && row < of_disc[d].size();
        const HalfBond h = real ? of_disc[d][row] : HalfBond{d, 1.0, 0.0, 0.0, 1.0, 0.0};
        s.neighbour.push_back(h.other);
        s.nx.push_back(h.nx);
        s.ny.push_back(h.ny);
        s.stretch.push_back(h.stretch);
        if (lengths) s.length.push_back(h.length);
        if (!stiffness.empty()) s.stiffness.push_back(h.stiffness);
      }
    }
    s.row_begin.push_back(static_cast<std::int32_t>(s.rows()));
  }
  return s;
}

std::vector<int> locality_order(const Packing& p) {
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
  std::vector<int> position(p.size());
  for (std::size_t k = 0; k < order.size(); ++k) position[order[k]] = static_cast<int>(k);
  return position;
}

}  // namespace ddem
