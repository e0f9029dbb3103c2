#include "meshes/packings/statistics.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "dem/assembly/contacts.h"
#include "meshes/packings/porosity.h"

namespace ddem::packings {
namespace {

constexpr double kNeighbourGap = 0.5;  // mean radii
constexpr double kOrdered = 0.9;

struct Touch {
  int i, j;             ///< j = -1: a wall
  double fx, fy;        ///< force on j
  double overlap;
};

std::vector<Touch> touches_of(const Packing& packing, FlatWalls walls) {
  std::vector<Touch> touches;
  for (const ClosePair& c : close_pairs(packing, 0.0)) {
    const double distance = std::sqrt(c.dx * c.dx + c.dy * c.dy);
    if (c.gap < 0.0 && distance > 0.0)
      touches.push_back({c.i, c.j, -c.gap * c.dx / distance, -c.gap * c.dy / distance, -c.gap});
  }
  for (int i = 0; i < static_cast<int>(packing.size()); ++i) {
    const auto touch = [&](double distance, double nx, double ny) {
      const double overlap = packing.radius[i] - distance;
      if (overlap > 0.0) touches.push_back({i, -1, nx * overlap, ny * overlap, overlap});
    };
    if (walls.x) {
      touch(packing.x[i], -1.0, 0.0);
      touch(packing.length - packing.x[i], 1.0, 0.0);
    }
    if (walls.y) {
      touch(packing.y[i], 0.0, -1.0);
      touch(packing.width - packing.y[i], 0.0, 1.0);
    }
  }
  return touches;
}

/// A mark for each disc that is none of the packing's skeleton. Two forces hold a disc only if they are collinear.
std::vector<char> rattlers_of(std::size_t discs, const std::vector<Touch>& touches) {
  std::vector<char> gone(discs, 0);
  for (bool changed = true; changed;) {
    changed = false;
    std::vector<int> held(discs, 0);
    for (const Touch& t : touches) {
      if (gone[t.i] || (t.j >= 0 && gone[t.j])) continue;
      ++held[t.i];
      if (t.j >= 0) ++held[t.j];
    }
    for (std::size_t i = 0; i < discs; ++i)
      if (!gone[i] && held[i] < 3) {
        gone[i] = 1;
        changed = true;
      }
  }
  return gone;
}

/// Contacts with walls count as those with discs do: each holds two discs, or one and its image.
double held_coordination(const std::vector<char>& gone, const std::vector<Touch>& touches) {
  const auto held = std::ranges::count(gone, 0);
  const auto holding = std::ranges::count_if(touches, [&](const Touch& t) { return !gone[t.i] && (t.j < 0 || !gone[t.j]); });
  return held == 0 ? 0.0 : 2.0 * static_cast<double>(holding) / static_cast<double>(held);
}

/// In two dimensions the eigenvalues of <n n> differ by |<exp(2 i angle)>|.
double fabric_anisotropy(const std::vector<Touch>& touches) {
  std::complex<double> sum = 0.0;
  double contacts = 0.0;
  for (const Touch& t : touches) {
    if (t.j < 0) continue;
    const std::complex<double> direction(t.fx, t.fy);
    sum += direction * direction / std::norm(direction);
    contacts += 1.0;
  }
  return contacts > 0.0 ? std::abs(sum) / contacts : 0.0;
}

double unbalanced_force(std::size_t discs, const std::vector<Touch>& touches) {
  std::vector<double> fx(discs, 0.0), fy(discs, 0.0);
  double sum = 0.0, largest2 = 0.0;
  for (const Touch& t : touches) {
    sum += t.overlap;
    fx[t.i] -= t.fx;
    fy[t.i] -= t.fy;
    if (t.j < 0) continue;
    fx[t.j] += t.fx;
    fy[t.j] += t.fy;
  }
  for (std::size_t i = 0; i < discs; ++i) largest2 = std::max(largest2, fx[i] * fx[i] + fy[i] * fy[i]);
  return touches.empty() ? 0.0 : std::sqrt(largest2) / (sum / static_cast<double>(touches.size()));
}

double ordered_fraction(const Packing& packing) {
  std::vector<std::complex<double>> psi(packing.size());
  std::vector<int> neighbours(packing.size(), 0);
  for (const ClosePair& c : close_pairs(packing, kNeighbourGap * mean_radius(packing))) {
    const std::complex<double> direction(c.dx, c.dy), square = direction * direction;
    const std::complex<double> sixth = square * square * square;
    const double size = std::abs(sixth);
    if (!(size > 0.0)) continue;
    for (const int d : {c.i, c.j}) {  // seen from the other end, the sixth power is the same
      psi[d] += sixth / size;
      ++neighbours[d];
    }
  }
  int ordered = 0;
  for (std::size_t i = 0; i < packing.size(); ++i)
    ordered += neighbours[i] == 6 && std::abs(psi[i]) > 6.0 * kOrdered ? 1 : 0;
  return static_cast<double>(ordered) / static_cast<double>(packing.size());
}

}  // namespace

PackingStatistics statistics_of(const Packing& packing, FlatWalls walls) {
  const std::vector<Touch> touches = touches_of(packing, walls);
  double overlap = 0.0;
  for (const Touch& t : touches) overlap = std::max(overlap, t.overlap);
  PackingStatistics s;
  s.porosity = porosity_of(packing);
  s.mean_radius = mean_radius(packing);
  s.largest_overlap = overlap / s.mean_radius;
  s.unbalanced_force = unbalanced_force(packing.size(), touches);
  s.contacts = static_cast<int>(touches.size());
  const std::vector<char> gone = rattlers_of(packing.size(), touches);
  s.rattlers = static_cast<int>(std::ranges::count_if(gone, [](char mark) { return mark != 0; }));
  s.held_coordination = held_coordination(gone, touches);
  s.fabric_anisotropy = fabric_anisotropy(touches);
  s.ordered_fraction = ordered_fraction(packing);
  return s;
}

}  // namespace ddem::packings
