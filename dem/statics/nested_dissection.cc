#include "dem/statics/nested_dissection.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

namespace ddem {
namespace {

constexpr double kRound = 0.9;          // of the period: discs that fill as much of it are taken for a ring
constexpr std::size_t kSmallest = 6;  // discs that are not divided further

class Dissection {
 public:
  Dissection(const Packing& packing, const std::vector<std::vector<int>>& neighbours)
      : packing_(packing), neighbours_(neighbours), discs_(packing.size()), part_(packing.size(), 0) {
    std::iota(discs_.begin(), discs_.end(), 0);
    order_.reserve(packing.size());
  }

  std::vector<int> run() {
    divide(discs_);
    return std::move(order_);
  }

 private:
  void divide(std::span<int> discs) {
    if (discs.size() <= kSmallest) {
      order_.insert(order_.end(), discs.begin(), discs.end());
      return;
    }
    const std::vector<double>& along = longer_side(discs);
    const auto middle = discs.begin() + static_cast<std::ptrdiff_t>(discs.size() / 2);
    std::nth_element(discs.begin(), middle, discs.end(), [&](int a, int b) { return std::pair(along[a], a) < std::pair(along[b], b); });
    const std::span<int> left(discs.begin(), middle), right(middle, discs.end());
    const int left_mark = ++parts_, right_mark = ++parts_;
    for (const int d : left) part_[d] = left_mark;
    for (const int d : right) part_[d] = right_mark;
    const auto borders = [&](int mark) {
      return [this, mark](int d) { return std::ranges::any_of(neighbours_[d], [&](int n) { return part_[n] == mark; }); };
    };
    // Of the discs along the cut those of the side with fewer of them.
    if (std::ranges::count_if(left, borders(right_mark)) <= std::ranges::count_if(right, borders(left_mark))) {
      separate(left, right, borders(right_mark));
    } else {
      separate(right, left, borders(left_mark));
    }
  }

  /// The part without its discs along the cut, the other, then those.
  template <class Borders>
  void separate(std::span<int> part, std::span<int> other, const Borders& borders) {
    const auto along_cut = std::stable_partition(part.begin(), part.end(), [&](int d) { return !borders(d); });
    divide({part.begin(), along_cut});
    divide(other);
    order_.insert(order_.end(), along_cut, part.end());
  }

  const std::vector<double>& longer_side(std::span<const int> discs) const {
    const auto extent = [&](const std::vector<double>& centre, double period) {
      const auto [low, high] = std::ranges::minmax(discs, {}, [&](int d) { return centre[d]; });
      const double size = centre[high] - centre[low];
      return size > kRound * period && period > 0.0 ? 0.5 * size : size;  // a ring takes two cuts
    };
    return extent(packing_.x, packing_.period.x) >= extent(packing_.y, packing_.period.y) ? packing_.x : packing_.y;
  }

  const Packing& packing_;
  const std::vector<std::vector<int>>& neighbours_;
  std::vector<int> discs_, order_;
  std::vector<int> part_;  ///< the last one that each disc was in
  int parts_ = 0;
};

}  // namespace

std::vector<int> nested_dissection(const Packing& packing, const std::vector<std::vector<int>>& neighbours) {
  return Dissection(packing, neighbours).run();
}

}  // namespace ddem
