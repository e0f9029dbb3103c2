#pragma once
// Small assemblies that tests share.

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "dem/assembly/assembly.h"
#include "dem/assembly/contacts.h"
#include "meshes/packings/hexagonal.h"
#include "tests/support/oracle_files.h"

namespace ddem::test {

inline constexpr double kDensity = 2000.0;
inline constexpr double kNormalStiffness = 1e10;

inline Assembly hexagonal_assembly(const packings::HexagonalSpec& spec, double thickness = 1.0) {
  const Packing p = packings::hexagonal(spec);
  return make_assembly(p, bonds_within_gap(p, 0.3 * mean_radius(p)), thickness, kDensity);
}

/// Three discs in a row, 0 and 1 bonded and touching, 2 at a gap.
inline Assembly three_discs(double radius, double gap) {
  Packing p;
  p.x = {radius, 3.0 * radius, 5.0 * radius + gap};
  p.y = {radius, radius, radius};
  p.radius = {radius, radius, radius};
  p.length = 6.0 * radius, p.width = 2.0 * radius;
  const std::vector<std::pair<int, int>> bonded{{0, 1}};
  return make_assembly(p, bonds_between(p, bonded), 1.0, kDensity, RattlerRule::apart);
}

/// A free-standing piece of a random periodic packing: 682 discs, gap tolerance 0.3 mean radii, bonds through the
/// periods cut.
inline Assembly random_free_strip() {
  Packing p = oracle_packing("packings/p682_s1.csv", {16.5e-3, 2e-3}, 16.5e-3, 2e-3);
  const Bonds bonds = cut_at_edges(p, bonds_within_gap(p, 0.3 * mean_radius(p)), true, true);
  p.period = {};
  return make_assembly(p, bonds, 1.0, kDensity);
}

/// A random packing of 682 discs periodic in x and y, gap tolerance 0.3 mean radii.
inline Assembly random_cell(int seed) {
  const Packing p = oracle_packing("packings/p682_s" + std::to_string(seed) + ".csv", {16.5e-3, 2e-3}, 16.5e-3, 2e-3);
  return make_assembly(p, bonds_within_gap(p, 0.3 * mean_radius(p)), 1.0, kDensity);
}

/// Deterministic noise in (-1, 1).
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : state_(seed * 0x9E3779B97F4A7C15ull + 1) {}
  double operator()() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 7;
    state_ ^= state_ << 17;
    return static_cast<double>(state_ >> 11) * 0x1.0p-52 - 1.0;
  }
  std::vector<double> vector(std::size_t n, double scale) {
    std::vector<double> v(n);
    for (double& x : v) x = scale * (*this)();
    return v;
  }

 private:
  std::uint64_t state_;
};

}  // namespace ddem::test
