#include "dem/assembly/contacts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "dem/assembly/neighbour_grid.h"

namespace ddem {
namespace {

// Beyond this many periods from the origin the nearest image is known to fewer than four digits.
constexpr double kMostPeriodsAway = 1e12;

void check_packing_for_search(const Packing& packing) {
  const std::size_t n = packing.size();
  if (packing.y.size() != n || packing.radius.size() != n)
    throw std::invalid_argument(fmt::format("a packing needs as many x as y and radii, but has {}, {} and {}",
                                            n, packing.y.size(), packing.radius.size()));
  for (const double period : {packing.period.x, packing.period.y})
    if (!std::isfinite(period) || period < 0.0)
      throw std::invalid_argument(fmt::format(
          "a period must be positive, or 0 where the packing is not periodic, but is {} m", period));
  const auto sane = [](double centre, double period) {
    return std::isfinite(centre) && (period <= 0.0 || std::abs(centre) <= kMostPeriodsAway * period);
  };
  for (std::size_t i = 0; i < n; ++i) {
    if (!sane(packing.x[i], packing.period.x) || !sane(packing.y[i], packing.period.y))
      throw std::invalid_argument(fmt::format("disc {}: its centre ({}, {}) is not a usable position", i,
                                              packing.x[i], packing.y[i]));
    if (!std::isfinite(packing.radius[i]) || packing.radius[i] <= 0.0)
      throw std::invalid_argument(
          fmt::format("disc {}: its radius must be positive and finite, but is {} m", i, packing.radius[i]));
  }
}

double largest_radius(const Packing& packing) {
  return *std::max_element(packing.radius.begin(), packing.radius.end());
}

/// Along a period of 2 reach or less, a disc and its image may both be within reach of another disc.
void check_periods(const Packing& packing, double reach) {
  const auto check = [&](double period, const char* direction) {
    if (period > 0.0 && period <= 2.0 * reach)
      throw std::invalid_argument(fmt::format(
          "the period in {0}, {1:.6g} m, must be longer than {2:.6g} m, twice the largest distance of "
          "neighbours (two largest radii and the gap): a pair could touch through two images. Take more "
          "discs in {0}, or a smaller gap",
          direction, period, 2.0 * reach));
  };
  check(packing.period.x, "x");
  check(packing.period.y, "y");
}

ClosePair pair_of(const Packing& packing, int i, int j) {
  const double dx = nearest_image(packing.x[j] - packing.x[i], packing.period.x);
  const double dy = nearest_image(packing.y[j] - packing.y[i], packing.period.y);
  return {i, j, dx, dy, std::sqrt(dx * dx + dy * dy) - packing.radius[i] - packing.radius[j]};
}

/// Gaps that differ by less than this differ by the rounding of coordinates only (touching discs of a
/// lattice).
double gap_rounding(const Packing& packing) {
  double largest = 0.0;
  for (std::size_t i = 0; i < packing.size(); ++i)
    largest = std::max({largest, std::abs(packing.x[i]), std::abs(packing.y[i]), packing.radius[i]});
  return 64.0 * std::numeric_limits<double>::epsilon() * largest;
}

/// Discs that a coordination is the mean of; all of them without marks.
class Counted {
 public:
  Counted(std::size_t discs, std::span<const char> marks) : marks_(marks), discs_(discs) {
    if (marks.empty()) return;
    if (marks.size() != discs)
      throw std::invalid_argument(fmt::format("{} marks for {} discs", marks.size(), discs));
    discs_ = static_cast<std::size_t>(std::count_if(marks.begin(), marks.end(), [](char mark) { return mark != 0; }));
  }

  std::size_t discs() const { return discs_; }
  std::size_t ends(int i, int j) const {
    return marks_.empty() ? 2 : (marks_[i] != 0 ? 1u : 0u) + (marks_[j] != 0 ? 1u : 0u);
  }

 private:
  std::span<const char> marks_;
  std::size_t discs_;
};

/// A pair that is bonded from this gap on, and how many of its ends count.
struct Candidate {
  double gap;
  std::size_t ends;
};

/// Pairs with counted ends, by ascending gap: at least enough for the ends wanted and one more, or else all up to `limit`.
std::vector<Candidate> closest(const Packing& packing, const Counted& counted, std::size_t wanted, double limit, double step) {
  for (double reach = std::min(step, limit);; reach = std::min(reach + step, limit)) {
    std::vector<Candidate> pairs;
    std::size_t ends = 0;
    for (const ClosePair& pair : close_pairs(packing, reach)) {
      const std::size_t own = counted.ends(pair.i, pair.j);
      if (own > 0) pairs.push_back({pair.gap, own});
      ends += own;
    }
    if (ends > wanted + 1 || reach >= limit) {
      std::stable_sort(pairs.begin(), pairs.end(), [](const Candidate& a, const Candidate& b) { return a.gap < b.gap; });
      return pairs;
    }
  }
}

}  // namespace

std::vector<ClosePair> close_pairs(const Packing& packing, double max_gap) {
  check_packing_for_search(packing);
  if (!std::isfinite(max_gap))
    throw std::invalid_argument(fmt::format("the largest gap must be finite, but is {} m", max_gap));
  std::vector<ClosePair> pairs;
  if (packing.size() < 2) return pairs;
  const double reach = 2.0 * largest_radius(packing) + max_gap;
  if (reach <= 0.0) return pairs;
  check_periods(packing, reach);

  const NeighbourGrid grid(packing, reach);
  pairs.reserve(3 * packing.size());
  for (int i = 0; i < static_cast<int>(packing.size()); ++i) {
    const auto first = static_cast<std::ptrdiff_t>(pairs.size());
    grid.for_each_candidate(packing.x[i], packing.y[i], [&](int j) {
      if (j <= i) return;
      const ClosePair pair = pair_of(packing, i, j);
      if (pair.gap <= max_gap) pairs.push_back(pair);
    });
    std::sort(pairs.begin() + first, pairs.end(),
              [](const ClosePair& a, const ClosePair& b) { return a.j < b.j; });
  }
  return pairs;
}

/// L / (r_i + r_j): of discs that touch but for round-off, one, so that the bonds of a lattice are all alike.
double stretch_of(double length, double radii) {
  constexpr double kRoundOff = 1e-12;
  const double stretch = length / radii;
  return std::abs(stretch - 1.0) < kRoundOff ? 1.0 : stretch;
}

Bonds bonds_of(const Packing& packing, std::span<const ClosePair> pairs) {
  Bonds bonds;
  for (auto* indices : {&bonds.i, &bonds.j}) indices->reserve(pairs.size());
  for (auto* values : {&bonds.nx, &bonds.ny, &bonds.length, &bonds.stretch, &bonds.arm_i, &bonds.arm_j})
    values->reserve(pairs.size());
  for (const ClosePair& pair : pairs) {
    const double length = std::sqrt(pair.dx * pair.dx + pair.dy * pair.dy);
    if (!(length > 0.0))
      throw std::invalid_argument(fmt::format(
          "discs {} and {} have the same centre: a bond between them has no direction", pair.i, pair.j));
    const double r_i = packing.radius[pair.i], r_j = packing.radius[pair.j];
    bonds.i.push_back(pair.i);
    bonds.j.push_back(pair.j);
    bonds.nx.push_back(pair.dx / length);
    bonds.ny.push_back(pair.dy / length);
    bonds.length.push_back(length);
    const double stretch = stretch_of(length, r_i + r_j);
    bonds.stretch.push_back(stretch);
    bonds.arm_i.push_back(r_i * stretch);
    bonds.arm_j.push_back(r_j * stretch);
  }
  return bonds;
}

Bonds bonds_within_gap(const Packing& packing, double bond_gap) {
  return bonds_of(packing, close_pairs(packing, bond_gap));
}

double gap_for_coordination(const Packing& packing, double coordination, std::span<const char> marks) {
  check_packing_for_search(packing);
  if (packing.size() < 2) throw std::invalid_argument("a coordination needs at least two discs");
  const Counted counted(packing.size(), marks);
  const auto discs = static_cast<double>(counted.discs());
  if (!(coordination > 0.0 && coordination < discs))
    throw std::invalid_argument(
        fmt::format("the coordination must be positive and below the number of discs, {}, but is {}", discs,
                    coordination));

  const double mean = mean_radius(packing);
  double limit = 2.0 * mean;
  for (const double period : {packing.period.x, packing.period.y})
    if (period > 0.0) limit = std::min(limit, 0.5 * period * (1.0 - 1e-12) - 2.0 * largest_radius(packing));
  const double wanted = coordination * discs;
  // Where even touching discs do not fit the period, `limit` is negative: the search for touching ones
  // throws.
  const std::vector<Candidate> pairs =
      closest(packing, counted, static_cast<std::size_t>(wanted), std::max(0.0, limit), 0.4 * mean);

  // The cut lies between two pairs whose gaps differ by more than rounding: the last cut at or below the number of ends
  // wanted, or the first above it.
  const double rounding = gap_rounding(packing);
  std::size_t below = 0, ends_below = 0, above = 0, ends_above = 0, ends = 0;
  for (std::size_t k = 0; k < pairs.size() && static_cast<double>(ends_above) < wanted; ++k) {
    ends += pairs[k].ends;
    if (k + 1 < pairs.size() && pairs[k + 1].gap - pairs[k].gap <= rounding) continue;
    if (static_cast<double>(ends) <= wanted) {
      below = k + 1;
      ends_below = ends;
    }
    above = k + 1;
    ends_above = ends;
  }
  const auto miss = [&](std::size_t n) { return std::abs(static_cast<double>(n) - wanted); };
  const bool take_below = miss(ends_below) <= miss(ends_above);
  const std::size_t bonds = take_below ? below : above;
  if (bonds == 0 || miss(take_below ? ends_below : ends_above) > 1.0 + 1e-9 * discs)
    throw std::invalid_argument(fmt::format(
        "no gap up to {:.4g} m (at most two mean radii, and half a period) gives a coordination of "
        "{:.6g}: the nearest are {:.6g} and {:.6g}",
        limit, coordination, static_cast<double>(ends_below) / discs, static_cast<double>(ends_above) / discs));
  const double next = bonds < pairs.size() ? pairs[bonds].gap : std::max(pairs[bonds - 1].gap, limit);
  return 0.5 * (pairs[bonds - 1].gap + next);
}

Bonds bonds_between(const Packing& packing, std::span<const std::pair<int, int>> pairs) {
  check_packing_for_search(packing);
  const auto discs = static_cast<int>(packing.size());
  std::vector<std::pair<int, int>> ordered(pairs.begin(), pairs.end());
  for (auto& [i, j] : ordered) {
    if (i < 0 || j < 0 || i >= discs || j >= discs)
      throw std::invalid_argument(
          fmt::format("bond ({}, {}): discs are numbered from 0 to {}", i, j, discs - 1));
    if (i == j)
      throw std::invalid_argument(fmt::format("bond ({}, {}): a disc cannot be bonded to itself", i, j));
    if (i > j) std::swap(i, j);
  }
  std::sort(ordered.begin(), ordered.end());
  if (const auto twice = std::adjacent_find(ordered.begin(), ordered.end()); twice != ordered.end())
    throw std::invalid_argument(fmt::format("bond ({}, {}) is given twice", twice->first, twice->second));

  std::vector<ClosePair> close;
  close.reserve(ordered.size());
  const auto ambiguous = [](double d, double period) {
    return period > 0.0 && std::abs(2.0 * std::abs(d) - period) <= 1e-9 * period;
  };
  for (const auto& [i, j] : ordered) {
    close.push_back(pair_of(packing, i, j));
    if (ambiguous(close.back().dx, packing.period.x) || ambiguous(close.back().dy, packing.period.y))
      throw std::invalid_argument(
          fmt::format("bond ({}, {}): two images of disc {} are equally near disc {}: which one is bonded? "
                      "Take a longer period",
                      i, j, j, i));
  }
  return bonds_of(packing, close);
}

double coordination(const Bonds& bonds, std::size_t discs) {
  if (discs == 0) throw std::invalid_argument("the coordination of no discs is not defined");
  return 2.0 * static_cast<double>(bonds.size()) / static_cast<double>(discs);
}

double coordination(const Bonds& bonds, std::span<const char> marks) {
  const Counted counted(marks.size(), marks);
  if (counted.discs() == 0) throw std::invalid_argument("the coordination of no discs is not defined");
  std::size_t ends = 0;
  for (std::size_t b = 0; b < bonds.size(); ++b) ends += counted.ends(bonds.i[b], bonds.j[b]);
  return static_cast<double>(ends) / static_cast<double>(counted.discs());
}

}  // namespace ddem
