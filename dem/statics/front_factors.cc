#include "dem/statics/front_factors.h"

#include <algorithm>
#include <atomic>
#include <optional>
#include <stdexcept>
#include <thread>

#include "dem/core/team.h"

namespace ddem {
namespace {

template <class Real>
std::ptrdiff_t rounded_up(std::ptrdiff_t n) { return (n + kFrontPack<Real> - 1) / kFrontPack<Real> * kFrontPack<Real>; }

/// Bonds by the front that eliminates the first of their discs: those of front f are the places begin[f] .. begin[f + 1] - 1.
struct BondsOfFronts {
  std::vector<std::size_t> begin, bond;
};

BondsOfFronts bonds_of_fronts(const BondSystem& s, const EliminationTree& tree) {
  BondsOfFronts b;
  b.begin.assign(tree.fronts.size() + 1, 0);
  b.bond.resize(s.first.size());
  const auto front = [&](std::size_t c) { return static_cast<std::size_t>(tree.front_of[std::min(s.first[c], s.second[c])]); };
  for (std::size_t c = 0; c < b.bond.size(); ++c) ++b.begin[front(c) + 1];
  for (std::size_t f = 0; f < tree.fronts.size(); ++f) b.begin[f + 1] += b.begin[f];
  std::vector<std::size_t> next = b.begin;
  for (std::size_t c = 0; c < b.bond.size(); ++c) b.bond[next[front(c)]++] = c;
  return b;
}

}  // namespace

/// Adds up one front after the other. What a range of fronts leaves over stands in `kept` of its last one.
template <class Real>
class FrontAssembly {
 public:
  using Kept = std::vector<AlignedVector<Real>>;

  FrontAssembly(const BondSystem& system, FrontFactors<Real>& factors, double regularisation, const BondsOfFronts& bonds, Kept& kept)
      : s_(system), factors_(factors), n_(system.unknowns_per_disc()), regularisation_(regularisation), bonds_(bonds), kept_(kept), row_(system.place.size()) {
    std::size_t panel = 0;
    for (const Front& f : factors.tree_->fronts) {
      const DenseFront<Real> d = factors.shape_of(f);
      panel = std::max(panel, static_cast<std::size_t>(d.own * d.stride));
    }
    if (factors.symmetric_) panel_.resize(panel);
  }

  void run(Subtrees::Range range) {
    for (int f = range.begin; f < range.end; ++f) eliminate(static_cast<std::size_t>(f));
    kept_[static_cast<std::size_t>(range.end) - 1].swap(left_over_);
    left_over_.clear();
  }

  /// Of those at the top, in their order.
  void eliminate(std::size_t f) {
    const Front& front = factors_.tree_->fronts[f];
    front_ = factors_.kept(f);
    if (front_.symmetric) front_.upper = panel_.data();
    schur_.assign(static_cast<std::size_t>(front_.rest * front_.rest_stride), Real(0));
    front_.schur = schur_.data();
    for (int p = front.begin; p < front.end; ++p) row_[p] = (p - front.begin) * n_;
    for (std::size_t k = 0; k < front.rest.size(); ++k) row_[front.rest[k]] = front_.own + static_cast<int>(k) * n_;
    for (std::size_t b = bonds_.begin[f]; b < bonds_.begin[f + 1]; ++b) add_bond(bonds_.bond[b]);
    for (int p = front.begin; p < front.end; ++p) add_diagonal(p);
    for (std::size_t child = front.children.size(); child-- > 0;) take_over(front.children[child]);
    if (!factors_.kernels_.eliminate(front_)) throw std::runtime_error("the static stiffness matrix could not be factorised");
    left_over_.insert(left_over_.end(), schur_.begin(), schur_.end());
  }

 private:
  /// Where an entry of the front stands that is not above the diagonal, or any of its columns where it is not symmetric.
  Real* column(int c) const {
    return c < front_.own ? front_.lower + c * front_.stride : front_.schur + (c - front_.own) * front_.rest_stride - front_.own;
  }

  void add_bond(std::size_t c) {
    const int place[] = {s_.first[c], s_.second[c]};
    for (const int a : {0, 1}) {
      for (const int b : {0, 1}) {
        const int row = row_[place[a]], col = row_[place[b]];
        if (front_.symmetric && row < col) continue;
        for (int r = 0; r < s_.rows_per_bond; ++r) add_block(c * s_.rows_per_bond + r, a, b, row, col);
      }
    }
  }

  /// l_a^T k r_b of one row of a bond.
  void add_block(std::size_t bond_row, int a, int b, int row, int col) {
    const std::size_t at = bond_row * 2 * n_;
    const double* right = s_.right.data() + at + b * n_;
    const double* left = (s_.symmetric() ? s_.right.data() : s_.left.data()) + at + a * n_;
    const double stiffness = s_.stiffness[static_cast<Eigen::Index>(bond_row)];
    if (col < front_.own || row >= front_.own) {
      for (int k = 0; k < n_; ++k) {
        Real* const to = column(col + k) + row;
        const double factor = stiffness * right[k];
        for (int m = 0; m < n_; ++m) to[m] += static_cast<Real>(left[m] * factor);
      }
    }
    if (front_.symmetric || row >= front_.own) return;
    for (int m = 0; m < n_; ++m) {
      Real* const to = front_.upper + (row + m) * front_.stride + col;
      const double factor = stiffness * left[m];
      for (int k = 0; k < n_; ++k) to[k] += static_cast<Real>(right[k] * factor);
    }
  }

  void add_to_diagonal(int at, double value) {
    front_.lower[at * front_.stride + at] += static_cast<Real>(value);
    if (!front_.symmetric) front_.upper[at * front_.stride + at] += static_cast<Real>(value);
  }

  void add_diagonal(int place) {
    const int at = row_[place];
    for (int k = 0; k < s_.displacements; ++k) {
      add_to_diagonal(at + k, s_.held[static_cast<std::size_t>(place) * n_ + k] ? 1.0 : regularisation_);
    }
    for (int k = 0; k < s_.strains; ++k) {
      add_to_diagonal(at + s_.displacements + k, s_.strain_stiffness[3 * static_cast<std::size_t>(place) + k]);
    }
  }

  /// Rows that stand together both in what a front has left over and in this front.
  struct Run {
    int from, to, size;
  };

  void find_runs(const std::vector<int>& rest) {
    runs_.clear();
    for (std::size_t k = 0; k < rest.size(); ++k) {
      const int from = static_cast<int>(k) * n_, to = row_[rest[k]];
      // The columns of those to be eliminated and of the rest are stored apart.
      if (!runs_.empty() && runs_.back().to + runs_.back().size == to && to != front_.own) {
        runs_.back().size += n_;
      } else {
        runs_.push_back({from, to, n_});
      }
    }
  }

  /// What a front has left over: of a range, or of the last of the earlier fronts that are not yet part of another.
  void take_over(int child) {
    if (AlignedVector<Real>& kept = kept_[static_cast<std::size_t>(child)]; !kept.empty()) {
      add_left_over(child, kept.data());
      AlignedVector<Real>().swap(kept);
      return;
    }
    const auto size = static_cast<std::ptrdiff_t>(factors_.tree_->fronts[child].rest.size()) * n_;
    const std::size_t begin = left_over_.size() - static_cast<std::size_t>(size * rounded_up<Real>(size));
    add_left_over(child, left_over_.data() + begin);
    left_over_.resize(begin);
  }

  void add_left_over(int child, const Real* values) {
    const std::vector<int>& rest = factors_.tree_->fronts[child].rest;
    const std::ptrdiff_t stride = rounded_up<Real>(static_cast<std::ptrdiff_t>(rest.size()) * n_);
    find_runs(rest);
    for (std::size_t b = 0; b < runs_.size(); ++b) {
      for (std::size_t a = front_.symmetric ? b : 0; a < runs_.size(); ++a) {
        const Run &rows = runs_[a], &columns = runs_[b];
        const Real* from = values + columns.from * stride + rows.from;
        if (columns.to < front_.own || rows.to >= front_.own) {
          for (int k = 0; k < columns.size; ++k) {
            Real* const to = column(columns.to + k) + rows.to;
            for (int m = 0; m < rows.size; ++m) to[m] += from[k * stride + m];
          }
        }
        if (front_.symmetric || rows.to >= front_.own) continue;
        for (int m = 0; m < rows.size; ++m) {
          Real* const to = front_.upper + (rows.to + m) * front_.stride + columns.to;
          for (int k = 0; k < columns.size; ++k) to[k] += from[k * stride + m];
        }
      }
    }
  }

  const BondSystem& s_;
  FrontFactors<Real>& factors_;
  const int n_;
  const double regularisation_;
  const BondsOfFronts& bonds_;
  Kept& kept_;
  std::vector<int> row_;  ///< of each place in the front that is being made
  std::vector<Run> runs_;
  DenseFront<Real> front_;
  AlignedVector<Real> panel_, schur_, left_over_;
};

template <class Real>
FrontFactors<Real>::FrontFactors(const BondSystem& system, std::shared_ptr<const EliminationTree> tree, double regularisation)
    : tree_(std::move(tree)), unknowns_per_disc_(system.unknowns_per_disc()), symmetric_(system.symmetric()),
      kernels_(front_kernels<Real>(best_instruction_set())), subtrees_(subtrees_of(*tree_)) {
  std::size_t entries = 0;
  for (const Front& f : tree_->fronts) {
    begin_.push_back(entries);
    const DenseFront<Real> d = shape_of(f);
    entries += static_cast<std::size_t>(d.own * d.stride);
  }
  lower_.resize(entries);
  if (!symmetric_) upper_.resize(entries);
  inverse_pivot_.resize(static_cast<std::size_t>(system.size()));
  const BondsOfFronts bonds = bonds_of_fronts(system, *tree_);
  typename FrontAssembly<Real>::Kept kept(tree_->fronts.size());
  each_subtree([&](const auto& next) {
    FrontAssembly<Real> assembly(system, *this, regularisation, bonds, kept);
    while (const auto range = next()) assembly.run(*range);
  });
  FrontAssembly<Real> assembly(system, *this, regularisation, bonds, kept);
  for (const int f : subtrees_.top) assembly.eliminate(static_cast<std::size_t>(f));
}

/// job(next), once a thread: next() is a subtree that none has taken yet, or nothing.
template <class Real>
template <class Job>
void FrontFactors<Real>::each_subtree(const Job& job) const {
  const std::size_t count = subtrees_.ranges.size();
  std::atomic<std::size_t> taken{0};
  const auto next = [&]() -> std::optional<Subtrees::Range> {
    const std::size_t k = taken++;
    return k < count ? std::optional(subtrees_.ranges[k]) : std::nullopt;
  };
  if (count <= 1) return job(next);
  Team(static_cast<int>(std::min<std::size_t>(count, std::max(1U, std::thread::hardware_concurrency())))).run([&](int) { job(next); });
}

template <class Real>
DenseFront<Real> FrontFactors<Real>::shape_of(const Front& front) const {
  DenseFront<Real> d;
  d.own = front.own() * unknowns_per_disc_;
  d.rest = static_cast<int>(front.rest.size()) * unknowns_per_disc_;
  d.rest_stride = rounded_up<Real>(d.rest);
  d.stride = rounded_up<Real>(d.own + d.rest_stride);
  d.symmetric = symmetric_;
  return d;
}

template <class Real>
DenseFront<Real> FrontFactors<Real>::kept(std::size_t f) const {
  DenseFront<Real> d = shape_of(tree_->fronts[f]);
  d.lower = lower_.data() + begin_[f];
  if (!symmetric_) d.upper = upper_.data() + begin_[f];
  d.inverse_pivot = inverse_pivot_.data() + static_cast<std::ptrdiff_t>(tree_->fronts[f].begin) * unknowns_per_disc_;
  return d;
}

/// What a front hands on to places behind its subtree is added up apart from the others': behind[k] are those of the subtree's rest.
template <class Real>
struct FrontFactors<Real>::Behind {
  const std::vector<int>* rest = nullptr;
  int end = 0;
  Columns values;
};

template <class Real>
void FrontFactors<Real>::at_front(std::size_t f, Columns& x, Columns& local, Behind* behind, bool forward) const {
  const int n = unknowns_per_disc_;
  const Front& front = tree_->fronts[f];
  const DenseFront<Real> d = kept(f);
  local.setZero(d.stride, x.cols());
  const Eigen::Index begin = static_cast<Eigen::Index>(front.begin) * n;
  const auto rest = [&](std::size_t k) {
    const int place = front.rest[k];
    if (behind == nullptr || place < behind->end) return x.middleRows(static_cast<Eigen::Index>(place) * n, n);
    const auto at = std::ranges::lower_bound(*behind->rest, place) - behind->rest->begin();
    return behind->values.middleRows(static_cast<Eigen::Index>(at) * n, n);
  };
  local.topRows(d.own) = x.middleRows(begin, d.own);
  for (std::size_t k = 0; k < front.rest.size(); ++k) local.middleRows(d.own + static_cast<Eigen::Index>(k) * n, n) = rest(k);
  (forward ? kernels_.forward : kernels_.backward)(d, FrontColumns<Real>{local.data(), local.rows(), static_cast<int>(local.cols())});
  x.middleRows(begin, d.own) = local.topRows(d.own);
  if (!forward) return;
  for (std::size_t k = 0; k < front.rest.size(); ++k) rest(k) = local.middleRows(d.own + static_cast<Eigen::Index>(k) * n, n);
}

template <class Real>
void FrontFactors<Real>::solve(Columns& x) const {
  const int n = unknowns_per_disc_;
  std::vector<Behind> behind(subtrees_.ranges.size());
  Columns local;
  each_subtree([&](const auto& next) {
    Columns own;
    while (const auto range = next()) {
      Behind& b = behind[static_cast<std::size_t>(std::ranges::lower_bound(subtrees_.ranges, range->begin, {}, &Subtrees::Range::begin) - subtrees_.ranges.begin())];
      const Front& last = tree_->fronts[static_cast<std::size_t>(range->end) - 1];
      b.rest = &last.rest, b.end = last.end;
      b.values.setZero(static_cast<Eigen::Index>(last.rest.size()) * n, x.cols());
      for (int f = range->begin; f < range->end; ++f) at_front(static_cast<std::size_t>(f), x, own, &b, true);
    }
  });
  for (const Behind& b : behind) {
    for (std::size_t k = 0; k < b.rest->size(); ++k) {
      x.middleRows(static_cast<Eigen::Index>((*b.rest)[k]) * n, n) += b.values.middleRows(static_cast<Eigen::Index>(k) * n, n);
    }
  }
  for (const int f : subtrees_.top) at_front(static_cast<std::size_t>(f), x, local, nullptr, true);
  for (std::size_t k = subtrees_.top.size(); k-- > 0;) at_front(static_cast<std::size_t>(subtrees_.top[k]), x, local, nullptr, false);
  each_subtree([&](const auto& next) {
    Columns own;
    while (const auto range = next()) {
      for (int f = range->end; f-- > range->begin;) at_front(static_cast<std::size_t>(f), x, own, nullptr, false);
    }
  });
}

template class FrontFactors<double>;
template class FrontFactors<float>;

}  // namespace ddem
