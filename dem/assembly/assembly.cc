#include "dem/assembly/assembly.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>

#include "dem/assembly/rattlers.h"

namespace ddem {
namespace {

Bonds select(const Bonds& bonds, const std::vector<char>& keep) {
  Bonds out;
  for (std::size_t c = 0; c < bonds.size(); ++c) {
    if (!keep[c]) continue;
    out.i.push_back(bonds.i[c]);
    out.j.push_back(bonds.j[c]);
    out.nx.push_back(bonds.nx[c]);
    out.ny.push_back(bonds.ny[c]);
    out.length.push_back(bonds.length[c]);
    out.stretch.push_back(bonds.stretch[c]);
    out.arm_i.push_back(bonds.arm_i[c]);
    out.arm_j.push_back(bonds.arm_j[c]);
  }
  return out;
}

std::vector<int> unbonded(std::size_t discs, const Bonds& bonds) {
  std::vector<char> bonded(discs, 0);
  for (std::size_t c = 0; c < bonds.size(); ++c) bonded[bonds.i[c]] = bonded[bonds.j[c]] = 1;
  std::vector<int> alone;
  for (std::size_t d = 0; d < discs; ++d) {
    if (!bonded[d]) alone.push_back(static_cast<int>(d));
  }
  return alone;
}

}  // namespace

Assembly make_assembly(Packing packing, Bonds bonds, double thickness, double density, RattlerRule rule) {
  Assembly a;
  const std::size_t n = packing.size();
  if (rule == RattlerRule::peel) a.rattlers = find_rattlers(n, bonds);
  if (rule == RattlerRule::apart) a.rattlers = unbonded(n, bonds);
  std::vector<char> is_rattler(n, 0);
  for (const int d : a.rattlers) is_rattler[d] = 1;
  std::vector<char> keep(bonds.size());
  for (std::size_t c = 0; c < bonds.size(); ++c) keep[c] = !is_rattler[bonds.i[c]] && !is_rattler[bonds.j[c]];
  a.bonds = select(bonds, keep);

  a.thickness = thickness;
  a.density = density;
  a.mass.resize(n);
  a.inertia.resize(n);
  a.volume.resize(n);
  for (std::size_t d = 0; d < n; ++d) {
    const double r = packing.radius[d];
    a.volume[d] = std::numbers::pi * r * r * thickness;
    a.mass[d] = density * a.volume[d];
    a.inertia[d] = 0.5 * a.mass[d] * r * r;
  }
  a.packing = std::move(packing);
  if (rule != RattlerRule::apart) require_one_network(a);
  return a;
}

void require_one_network(const Assembly& a) {
  const std::size_t discs = a.size();
  if (a.rattlers.size() == discs) {
    throw std::invalid_argument("the assembly has no bonded network: every disc has fewer than two bonds; raise bond_gap or coordination");
  }
  const auto networks = connected_components(discs, a.bonds, a.rattlers);
  if (networks.size() == 1) return;
  const auto smallest = std::min_element(networks.begin(), networks.end(), [](const auto& x, const auto& y) { return x.size() < y.size(); });
  throw std::invalid_argument("the assembly falls apart into " + std::to_string(networks.size()) +
                              " networks without a bond between them (the smallest has " + std::to_string(smallest->size()) +
                              " discs, among them disc " + std::to_string(smallest->front()) +
                              "); raise bond_gap or coordination, or name the missing bonds");
}

Bonds cut_at_edges(const Packing& packing, const Bonds& bonds, bool cut_x, bool cut_y) {
  std::vector<char> keep(bonds.size());
  for (std::size_t c = 0; c < bonds.size(); ++c) {
    const double dx = packing.x[bonds.j[c]] - packing.x[bonds.i[c]];
    const double dy = packing.y[bonds.j[c]] - packing.y[bonds.i[c]];
    // A bond crosses an edge when its direct vector is not the vector to the bonded image.
    const double tolerance = 1e-6 * bonds.length[c];
    const bool crosses_x = std::abs(dx - bonds.nx[c] * bonds.length[c]) > tolerance;
    const bool crosses_y = std::abs(dy - bonds.ny[c] * bonds.length[c]) > tolerance;
    keep[c] = !(cut_x && crosses_x) && !(cut_y && crosses_y);
  }
  return select(bonds, keep);
}

std::vector<int> network_discs(const Assembly& a) {
  std::vector<int> discs;
  auto rattler = a.rattlers.begin();
  for (int d = 0; d < static_cast<int>(a.size()); ++d) {
    if (rattler != a.rattlers.end() && *rattler == d) {
      ++rattler;
    } else {
      discs.push_back(d);
    }
  }
  return discs;
}

double moving_density(const Assembly& a) {
  if (a.rattlers.empty()) return bulk_density(a);
  double mass = 0.0;
  for (const int d : network_discs(a)) mass += a.mass[d];
  return mass / (a.area() * a.thickness);
}

double solid_fraction(const Assembly& a) {
  return std::accumulate(a.volume.begin(), a.volume.end(), 0.0) / (a.area() * a.thickness);
}

double bulk_density(const Assembly& a) { return a.density * solid_fraction(a); }

namespace {

std::vector<int> outermost(const Packing& packing, const std::vector<int>& among, Edge edge, double band) {
  const bool horizontal = edge == Edge::left || edge == Edge::right;
  const double sign = edge == Edge::left || edge == Edge::bottom ? 1.0 : -1.0;
  const std::vector<double>& coordinate = horizontal ? packing.x : packing.y;
  double outermost = HUGE_VAL;
  for (const int d : among) outermost = std::min(outermost, sign * coordinate[d]);
  std::vector<int> discs;
  for (const int d : among) {
    if (sign * coordinate[d] <= outermost + band) discs.push_back(d);
  }
  return discs;
}

}  // namespace

std::vector<int> edge_discs(const Packing& packing, Edge edge, double band) {
  std::vector<int> all(packing.size());
  std::iota(all.begin(), all.end(), 0);
  return outermost(packing, all, edge, band);
}

Ends network_ends(const Assembly& a) {
  std::vector<double> x;
  for (const int d : network_discs(a)) x.push_back(a.packing.x[d]);
  if (x.empty()) x = a.packing.x;
  const auto [left, right] = std::minmax_element(x.begin(), x.end());
  return {*left, *right};
}

std::vector<int> edge_discs(const Assembly& a, Edge edge, double band) { return outermost(a.packing, network_discs(a), edge, band); }

}  // namespace ddem
