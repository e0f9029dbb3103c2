#include "dem/statics/front_factors.h"

#include <algorithm>
#include <stdexcept>

namespace ddem {
namespace {

constexpr std::ptrdiff_t kPack = 8;

std::ptrdiff_t rounded_up(std::ptrdiff_t n) { return (n + kPack - 1) / kPack * kPack; }

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

/// Adds up one front after the other.
class FrontAssembly {
 public:
  FrontAssembly(const BondSystem& system, FrontFactors& factors, double regularisation)
      : s_(system), factors_(factors), n_(system.unknowns_per_disc()), regularisation_(regularisation), row_(system.place.size()),
        bonds_(bonds_of_fronts(system, factors.tree_)) {
    std::size_t panel = 0;
    for (const Front& f : factors.tree_.fronts) {
      const DenseFront d = factors.shape_of(f);
      panel = std::max(panel, static_cast<std::size_t>(d.own * d.stride));
    }
    if (factors.symmetric_) panel_.resize(panel);
  }

  void run() {
    for (std::size_t f = 0; f < factors_.tree_.fronts.size(); ++f) eliminate(f);
  }

 private:
  void eliminate(std::size_t f) {
    const Front& front = factors_.tree_.fronts[f];
    front_ = factors_.kept(f);
    if (front_.symmetric) front_.upper = panel_.data();
    schur_.assign(static_cast<std::size_t>(front_.rest * front_.rest_stride), 0.0);
    front_.schur = schur_.data();
    for (int p = front.begin; p < front.end; ++p) row_[p] = (p - front.begin) * n_;
    for (std::size_t k = 0; k < front.rest.size(); ++k) row_[front.rest[k]] = front_.own + static_cast<int>(k) * n_;
    for (std::size_t b = bonds_.begin[f]; b < bonds_.begin[f + 1]; ++b) add_bond(bonds_.bond[b]);
    for (int p = front.begin; p < front.end; ++p) add_diagonal(p);
    for (std::size_t child = front.children.size(); child-- > 0;) take_over(front.children[child]);
    if (!factors_.kernels_.eliminate(front_)) throw std::runtime_error("the static stiffness matrix could not be factorised");
    left_over_.insert(left_over_.end(), schur_.begin(), schur_.end());
  }

  /// Where an entry of the front stands that is not above the diagonal, or any of its columns where it is not symmetric.
  double* column(int c) const {
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
        double* const to = column(col + k) + row;
        const double factor = stiffness * right[k];
        for (int m = 0; m < n_; ++m) to[m] += left[m] * factor;
      }
    }
    if (front_.symmetric || row >= front_.own) return;
    for (int m = 0; m < n_; ++m) {
      double* const to = front_.upper + (row + m) * front_.stride + col;
      const double factor = stiffness * left[m];
      for (int k = 0; k < n_; ++k) to[k] += right[k] * factor;
    }
  }

  void add_to_diagonal(int at, double value) {
    front_.lower[at * front_.stride + at] += value;
    if (!front_.symmetric) front_.upper[at * front_.stride + at] += value;
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

  /// What the last of the earlier fronts that are not yet part of another has left over.
  void take_over(int child) {
    const std::vector<int>& rest = factors_.tree_.fronts[child].rest;
    const std::ptrdiff_t size = static_cast<std::ptrdiff_t>(rest.size()) * n_, stride = rounded_up(size);
    const std::size_t begin = left_over_.size() - static_cast<std::size_t>(size * stride);
    find_runs(rest);
    for (std::size_t b = 0; b < runs_.size(); ++b) {
      for (std::size_t a = front_.symmetric ? b : 0; a < runs_.size(); ++a) {
        const Run &rows = runs_[a], &columns = runs_[b];
        const double* from = left_over_.data() + begin + columns.from * stride + rows.from;
        if (columns.to < front_.own || rows.to >= front_.own) {
          for (int k = 0; k < columns.size; ++k) {
            double* const to = column(columns.to + k) + rows.to;
            for (int m = 0; m < rows.size; ++m) to[m] += from[k * stride + m];
          }
        }
        if (front_.symmetric || rows.to >= front_.own) continue;
        for (int m = 0; m < rows.size; ++m) {
          double* const to = front_.upper + (rows.to + m) * front_.stride + columns.to;
          for (int k = 0; k < columns.size; ++k) to[k] += from[k * stride + m];
        }
      }
    }
    left_over_.resize(begin);
  }

  const BondSystem& s_;
  FrontFactors& factors_;
  const int n_;
  const double regularisation_;
  std::vector<int> row_;  ///< of each place in the front that is being made
  BondsOfFronts bonds_;
  std::vector<Run> runs_;
  DenseFront front_;
  AlignedVector<double> panel_, schur_, left_over_;
};

FrontFactors::FrontFactors(const BondSystem& system, EliminationTree tree, double regularisation)
    : tree_(std::move(tree)), unknowns_per_disc_(system.unknowns_per_disc()), symmetric_(system.symmetric()),
      kernels_(front_kernels(best_instruction_set())) {
  std::size_t entries = 0;
  for (const Front& f : tree_.fronts) {
    begin_.push_back(entries);
    const DenseFront d = shape_of(f);
    entries += static_cast<std::size_t>(d.own * d.stride);
  }
  lower_.resize(entries);
  if (!symmetric_) upper_.resize(entries);
  inverse_pivot_.resize(static_cast<std::size_t>(system.size()));
  FrontAssembly(system, *this, regularisation).run();
}

DenseFront FrontFactors::shape_of(const Front& front) const {
  DenseFront d;
  d.own = front.own() * unknowns_per_disc_;
  d.rest = static_cast<int>(front.rest.size()) * unknowns_per_disc_;
  d.rest_stride = rounded_up(d.rest);
  d.stride = rounded_up(d.own + d.rest_stride);
  d.symmetric = symmetric_;
  return d;
}

DenseFront FrontFactors::kept(std::size_t f) const {
  DenseFront d = shape_of(tree_.fronts[f]);
  d.lower = lower_.data() + begin_[f];
  if (!symmetric_) d.upper = upper_.data() + begin_[f];
  d.inverse_pivot = inverse_pivot_.data() + static_cast<std::ptrdiff_t>(tree_.fronts[f].begin) * unknowns_per_disc_;
  return d;
}

void FrontFactors::solve(Eigen::MatrixXd& x) const {
  const int n = unknowns_per_disc_;
  Eigen::MatrixXd local;
  const auto at_front = [&](std::size_t f, auto kernel, bool hand_on) {
    const Front& front = tree_.fronts[f];
    const DenseFront d = kept(f);
    local.setZero(d.stride, x.cols());
    const Eigen::Index begin = static_cast<Eigen::Index>(front.begin) * n;
    local.topRows(d.own) = x.middleRows(begin, d.own);
    for (std::size_t k = 0; k < front.rest.size(); ++k) {
      local.middleRows(d.own + static_cast<Eigen::Index>(k) * n, n) = x.middleRows(static_cast<Eigen::Index>(front.rest[k]) * n, n);
    }
    kernel(d, FrontColumns{local.data(), local.rows(), static_cast<int>(local.cols())});
    x.middleRows(begin, d.own) = local.topRows(d.own);
    if (!hand_on) return;
    for (std::size_t k = 0; k < front.rest.size(); ++k) {
      x.middleRows(static_cast<Eigen::Index>(front.rest[k]) * n, n) = local.middleRows(d.own + static_cast<Eigen::Index>(k) * n, n);
    }
  };
  for (std::size_t f = 0; f < tree_.fronts.size(); ++f) at_front(f, kernels_.forward, true);
  for (std::size_t f = tree_.fronts.size(); f-- > 0;) at_front(f, kernels_.backward, false);
}

}  // namespace ddem
