#include "meshes/packings/random.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "dem/assembly/contacts.h"
#include "meshes/packings/rng.h"
#include "meshes/packings/soft_discs.h"

namespace ddem::packings {
namespace {

// Above the jamming point at most radius ratios; a packing that is not jammed yet is inflated further.
constexpr double kFirstSolidFraction = 0.88;
constexpr double kSqueeze = 1.01;

constexpr double kNoOverlap = 2e-5;     // below it a packing counts as loose, mean radii
constexpr double kAim = 0.8;            // of kJammedOverlap: where the last shrinking aims at
// Largest net force over the mean contact force, on the way and in the end. Roughly balanced packings come to the last
// overlap in a quarter of the iterations, but then need several times as many to settle there.
constexpr double kRoughBalance = 1e-3, kForceBalance = 1e-4;

// Of the step that affine motion suggests, which leaves a third of the overlap after relaxation
// (measured: 1.3 leaves a tenth, 1.6 nothing). Below the shortest step the search has lost its way.
constexpr double kShrink = 1.0, kShortestStep = 1e-2;

// Forces summed in another order round differently. Radii are scaled one after the other, and round alike.
// The last balancing may press a little harder.
constexpr double kSameBalance = 1.01 * kForceBalance, kSameOverlap = 1.1 * kJammedOverlap, kRoundOff = 1e-12;
constexpr double kFarthestMove = 0.15;  // of the cell: see is_near()

constexpr int kPatience = 60000;          // iterations of one minimisation: most take a few thousand
constexpr int kMostIterations = 1000000;  // in all: 682 discs take 1e4, 1e4 discs take 6e4
constexpr int kMostDiscs = 100000;

void check_spec(const RandomSpec& spec) {
  const auto positive = [](double value) { return std::isfinite(value) && value > 0.0; };
  if (!positive(spec.length) || !positive(spec.width))
    throw std::invalid_argument(
        fmt::format("a random packing needs a positive length and width, but has {} m and {} m", spec.length,
                    spec.width));
  if (!(spec.radius_ratio >= 1.0 && spec.radius_ratio <= 10.0))
    throw std::invalid_argument(fmt::format(
        "the ratio of the largest to the smallest radius must be 1 to 10, but is {}", spec.radius_ratio));
  if (const SieveCurve& s = spec.grading.sieve; spec.grading.law == Grading::Law::sieve && !(s.radius.size() > 1 && s.radius.back() <= 10.0 * s.radius.front()))
    throw std::invalid_argument("the largest radius of a sieve curve must be at most ten times the smallest");
  if (spec.discs < 2)
    throw std::invalid_argument(
        fmt::format("a random packing needs at least two discs, but has {}", spec.discs));
  if (spec.discs > kMostDiscs)
    throw std::invalid_argument(
        fmt::format("{} discs would take too long to jam, at most {} are possible: jam a smaller periodic "
                    "cell and tile it",
                    spec.discs, kMostDiscs));
}

/// In random order; scaled to fill the cell to `solid_fraction`.
std::vector<double> radii_of(const RandomSpec& spec, double solid_fraction, Rng& rng) {
  std::vector<double> radii = graded_radii(spec.grading, spec.radius_ratio, spec.discs);
  double area = 0.0;
  for (const double radius : radii) area += std::numbers::pi * radius * radius;
  const double scale = std::sqrt(solid_fraction * spec.length * spec.width / area);
  for (double& radius : radii) radius *= scale;
  for (std::size_t k = radii.size() - 1; k > 0; --k) std::swap(radii[k], radii[rng.below(k + 1)]);
  return radii;
}

Packing random_points(const RandomSpec& spec) {
  Rng rng(spec.seed);
  Packing packing;
  packing.length = spec.length;
  packing.width = spec.width;
  packing.period = {spec.walls.x ? 0.0 : spec.length, spec.walls.y ? 0.0 : spec.width};
  packing.radius = radii_of(spec, kFirstSolidFraction, rng);
  for (int i = 0; i < spec.discs; ++i) {
    packing.x.push_back(spec.length * rng.uniform());
    packing.y.push_back(spec.width * rng.uniform());
  }
  // Neighbours in space are neighbours in memory; the radii are in random order anyway.
  std::sort(packing.x.begin(), packing.x.end());
  return packing;
}

/// Discs in the narrower direction must not touch through two images, whatever the later growth; between walls there
/// is the same room.
void check_room(const Packing& packing) {
  const double largest = *std::max_element(packing.radius.begin(), packing.radius.end());
  const double needed = 2.0 * (2.0 * largest + mean_radius(packing));
  if (std::min(packing.length, packing.width) <= needed)
    throw std::invalid_argument(
        fmt::format("{} discs in {:.6g} m x {:.6g} m would be so large that a pair could touch through two "
                    "periodic images, or reach from wall to wall: "
                    "both sides must be longer than {:.4g} m. Take more discs, or a smaller radius ratio",
                    packing.size(), packing.length, packing.width, needed));
}

/// Search for the jamming point. Shrinking the radii by the fraction mean overlap / mean distance would, with
/// affine motion, lose all contacts at once: steps in proportion to that, each followed by relaxation,
/// approach the jamming point from the jammed side; where a packing came apart, half of the step is tried.
class JammingSearch {
 public:
  JammingSearch(Packing start, FlatWalls walls, const std::function<void(double)>& progress)
      : walls_(walls), discs_(std::move(start), walls), progress_(progress) {}

  /// Until all contacts are in balance and the largest overlap is within kJammedOverlap.
  void run() {
    while (iterations_ < kMostIterations) {
      Outcome outcome = relax(kRoughBalance);
      const bool near = outcome == Outcome::jammed && state_.largest_overlap <= kJammedOverlap * unit();
      if (near) outcome = relax(kForceBalance);
      if (outcome != Outcome::jammed)
        grow_back(outcome);
      else if (!near)
        shrink();
      else
        return;
    }
    throw std::runtime_error(fmt::format(
        "random packing: no jammed packing in force balance within {} iterations of the minimiser (largest "
        "overlap {:.2g} mean radii, largest net force {:.2g} of the mean contact force): try another seed",
        kMostIterations, state_.largest_overlap / unit(), state_.unbalanced_force));
  }

  const Packing& packing() const { return discs_.packing(); }

 private:
  enum class Outcome { jammed, loose, undecided };

  double unit() const { return mean_radius(discs_.packing()); }

  Outcome relax(double force_balance) {
    state_ = discs_.minimise({force_balance, kNoOverlap * unit(), kPatience});
    iterations_ += state_.iterations;
    if (progress_) progress_(state_.largest_overlap / unit());
    if (!state_.converged) return Outcome::undecided;
    return state_.largest_overlap > kNoOverlap * unit() ? Outcome::jammed : Outcome::loose;
  }

  void shrink() {
    jammed_ = discs_.packing();
    bracket_ -= step_;
    // Shrinking by the fraction f of what affine motion suggests leaves about 1 - 2 f/3 of the overlaps.
    const double surplus = 1.0 - kAim * kJammedOverlap * unit() / state_.largest_overlap;
    const double wanted = std::min(kShrink, 1.5 * surplus) * state_.mean_overlap / (2.0 * unit());
    step_ = std::min(wanted, 0.5 * bracket_);
    if (step_ < kShortestStep * wanted) {
      // Jammed this side and loose that side of a point that is not the jamming point: the packing rearranged
      // there. Squeeze it into another arrangement.
      discs_.scale_radii(kSqueeze);
      jammed_.reset();
      bracket_ = std::numeric_limits<double>::infinity();
      step_ = 0.0;
      return;
    }
    discs_.scale_radii(1.0 - step_);
  }

  /// From the last jammed packing half as far; only a loose packing bounds how far its radii can shrink.
  void grow_back(Outcome outcome) {
    if (!jammed_) {
      discs_.scale_radii(kSqueeze);
      return;
    }
    if (outcome == Outcome::loose) bracket_ = step_;
    step_ *= 0.5;
    discs_ = SoftDiscs(*jammed_, walls_);
    discs_.scale_radii(1.0 - step_);
  }

  FlatWalls walls_;
  SoftDiscs discs_;
  const std::function<void(double)>& progress_;
  SoftDiscs::State state_;
  std::optional<Packing> jammed_;  ///< the last one, and how much more its radii may at most shrink
  double bracket_ = std::numeric_limits<double>::infinity();
  double step_ = 0.0;
  int iterations_ = 0;
};

/// Centres inside the cell, discs numbered from left to right: neighbours in space are neighbours in memory.
Packing tidied(const Packing& packing) {
  Packing result = packing;
  const auto wrap = [](double centre, double period) {
    if (period <= 0.0) return centre;
    const double inside = centre - period * std::floor(centre / period);
    return inside < period ? inside : 0.0;
  };
  std::vector<std::size_t> order(packing.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::vector<double> x(packing.size());
  for (std::size_t i = 0; i < packing.size(); ++i) x[i] = wrap(packing.x[i], packing.period.x);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return x[a] < x[b]; });
  for (std::size_t k = 0; k < order.size(); ++k) {
    result.x[k] = x[order[k]];
    result.y[k] = wrap(packing.y[order[k]], packing.period.y);
    result.radius[k] = packing.radius[order[k]];
  }
  return result;
}

bool is_inside(const Packing& packing) {
  const auto inside = [](const std::vector<double>& centres, double end) {
    return std::ranges::all_of(centres, [&](double c) { return c >= 0.0 && c <= end; });  // not a NaN
  };
  return inside(packing.x, packing.length) && inside(packing.y, packing.width) && std::ranges::is_sorted(packing.x);
}

/// The places of discs from the smallest to the largest.
std::vector<std::size_t> by_radius(const Packing& packing) {
  std::vector<std::size_t> order(packing.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return packing.radius[i]; });
  return order;
}

/// One factor times the radii of the start.
bool has_radii_of(const Packing& start, const Packing& packing) {
  if (!std::ranges::all_of(packing.radius, [&](double r) { return r > 0.0 && r < packing.length; })) return false;
  const std::vector<std::size_t> before = by_radius(start), now = by_radius(packing);
  const double factor = packing.radius[now.back()] / start.radius[before.back()];
  for (std::size_t k = 0; k < now.size(); ++k) {
    const double expected = factor * start.radius[before[k]];
    if (std::abs(packing.radius[now[k]] - expected) > kRoundOff * expected) return false;
  }
  return true;
}

/// Whether no place holds more discs than fit there: overlaps are looked for pair by pair.
bool is_spread(const Packing& packing) {
  const auto [smallest, largest] = std::ranges::minmax(packing.radius);
  const double side = 2.0 * largest, across = (side + 2.0 * smallest) / smallest;
  std::vector<std::pair<double, double>> cells;
  for (std::size_t i = 0; i < packing.size(); ++i) cells.emplace_back(std::floor(packing.x[i] / side), std::floor(packing.y[i] / side));
  std::ranges::sort(cells);
  const auto most = static_cast<std::size_t>(across * across / std::numbers::pi) + 1;
  for (std::size_t k = most; k < cells.size(); ++k) {
    if (cells[k] == cells[k - most]) return false;
  }
  return true;
}

/// Whether discs, told by their radii, are near where they started in x, or in y: of the middle one the distance is below a tenth
/// of the cell's length, or width, in 112 packings of 40 to 2500 discs, and about a quarter of it in those of other seeds.
bool is_near(const std::vector<double>& start, const std::vector<std::size_t>& before, const std::vector<double>& centres,
             const std::vector<std::size_t>& now, double size, double period) {
  std::vector<double> moves;
  for (std::size_t k = 0; k < now.size(); ++k) {
    const double move = centres[now[k]] - start[before[k]];
    moves.push_back(std::abs(period > 0.0 ? move - period * std::round(move / period) : move));
  }
  const auto middle = moves.begin() + static_cast<std::ptrdiff_t>(moves.size() / 2);
  std::ranges::nth_element(moves, middle);
  return *middle < kFarthestMove * size;
}

bool are_told_apart(const std::vector<double>& ascending) {
  return std::ranges::adjacent_find(ascending, [](double a, double b) { return b - a <= kRoundOff * b; }) == ascending.end();
}

bool is_near(const Packing& start, const Packing& packing) {
  const std::vector<std::size_t> before = by_radius(start), now = by_radius(packing);
  return is_near(start.x, before, packing.x, now, packing.length, packing.period.x) &&
         is_near(start.y, before, packing.y, now, packing.width, packing.period.y);
}

}  // namespace

bool can_be_jammed_from(const Packing& packing, const RandomSpec& spec) {
  check_spec(spec);
  const Packing start = random_points(spec);
  if (packing.size() != start.size() || packing.y.size() != start.size() || packing.radius.size() != start.size()) return false;
  if (packing.length != start.length || packing.width != start.width) return false;
  if (packing.period.x != start.period.x || packing.period.y != start.period.y) return false;
  if (!is_inside(packing) || !has_radii_of(start, packing) || !is_spread(packing)) return false;
  if (are_told_apart(graded_radii(spec.grading, spec.radius_ratio, spec.discs)) && !is_near(start, packing)) return false;
  const double unit = mean_radius(packing);
  const SoftDiscs::State state = SoftDiscs(packing, spec.walls).minimise({kSameBalance, 0.0, 1});
  return state.converged && state.largest_overlap > kNoOverlap * unit && state.largest_overlap <= kSameOverlap * unit;
}

Packing random_jammed(const RandomSpec& spec, const std::function<void(double)>& progress) {
  check_spec(spec);
  Packing start = random_points(spec);
  check_room(start);
  JammingSearch search(std::move(start), spec.walls, progress);
  search.run();
  return tidied(search.packing());
}

}  // namespace ddem::packings
