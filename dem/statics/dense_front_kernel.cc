// Compiled once per instruction set: see dem/CMakeLists.txt. Every sum is taken in the same order whatever the set.
#include "dem/statics/dense_front.h"

namespace ddem::DDEM_ISA {
namespace {

constexpr int kColumns = 4;
#ifdef __AVX512F__
constexpr int kPacks = 2;  // rows of a tile in packs: as many as the registers hold
#else
constexpr int kPacks = 1;
#endif

template <class Real>
struct Simd {
  static constexpr int width = static_cast<int>(kFrontPack<Real>);
  typedef Real Pack __attribute__((vector_size(64)));
  typedef Real InMemory __attribute__((vector_size(64), aligned(alignof(Real)), may_alias));  // wherever it starts (of a using clang takes no alignment)
};

template <class Real>
[[gnu::always_inline]] inline typename Simd<Real>::Pack load(const Real* p) { return *reinterpret_cast<const typename Simd<Real>::InMemory*>(p); }
template <class Real>
[[gnu::always_inline]] inline void store(Real* p, typename Simd<Real>::Pack v) { *reinterpret_cast<typename Simd<Real>::InMemory*>(p) = v; }

/// Columns of equal stride.
template <class Real>
struct Block {
  const Real* at;
  std::ptrdiff_t stride;
};

/// C -= A B^T for a tile of C, the sum over `depth` in registers.
template <int packs, int columns, class Real>
[[gnu::always_inline]] inline void subtract_tile(Real* c, std::ptrdiff_t stride, Block<Real> from, Block<Real> factors, int depth) {
  constexpr int width = Simd<Real>::width;
  const Real *a = from.at, *b = factors.at;
  typename Simd<Real>::Pack sum[columns][packs];
  for (int j = 0; j < columns; ++j) {
    for (int p = 0; p < packs; ++p) sum[j][p] = load(c + j * stride + p * width);
  }
  for (int k = 0; k < depth; ++k, a += from.stride, b += factors.stride) {
    for (int j = 0; j < columns; ++j) {
      for (int p = 0; p < packs; ++p) sum[j][p] -= load(a + p * width) * b[j];
    }
  }
  for (int j = 0; j < columns; ++j) {
    for (int p = 0; p < packs; ++p) store(c + j * stride + p * width, sum[j][p]);
  }
}

/// The rows of `columns` columns, whole packs of them.
template <int columns, class Real>
void subtract_columns(Real* c, std::ptrdiff_t stride, Block<Real> a, Block<Real> b, std::ptrdiff_t rows, int depth) {
  constexpr int width = Simd<Real>::width;
  std::ptrdiff_t r = 0;
  for (; r + kPacks * width <= rows; r += kPacks * width) subtract_tile<kPacks, columns>(c + r, stride, {a.at + r, a.stride}, b, depth);
  for (; r < rows; r += width) subtract_tile<1, columns>(c + r, stride, {a.at + r, a.stride}, b, depth);
}

/// C -= A B^T; `below`: only what is not above the diagonal of C is asked for, of which column 0 has row `diagonal`.
template <class Real>
void subtract_in_cache(Real* c, std::ptrdiff_t stride, Block<Real> a, Block<Real> b, std::ptrdiff_t rows, int columns, int depth, bool below, std::ptrdiff_t diagonal) {
  for (int j = 0; j < columns; j += kColumns) {
    const std::ptrdiff_t row = diagonal + j, first = below && row > 0 ? row - row % Simd<Real>::width : 0;
    if (first >= rows) return;
    Real* const to = c + j * stride + first;
    const Block<Real> from{a.at + first, a.stride}, factors{b.at + j, b.stride};
    switch (columns - j) {
      case 1: subtract_columns<1>(to, stride, from, factors, rows - first, depth); break;
      case 2: subtract_columns<2>(to, stride, from, factors, rows - first, depth); break;
      case 3: subtract_columns<3>(to, stride, from, factors, rows - first, depth); break;
      default: subtract_columns<kColumns>(to, stride, from, factors, rows - first, depth);
    }
  }
}

// Blocks of A and B that stay in the caches next to the processor while they are multiplied: A in the second (196 kB), four columns of B in the first.
constexpr int kBlockDepth = 256, kBlockBytes = 768, kBlockColumns = 64;
constexpr std::ptrdiff_t kFitsInCache = 1 << 18;  // bytes of A: more than so many are multiplied block by block,
constexpr int kFewColumns = 32;                   // unless copies would be used for fewer columns

/// The same, by blocks of A and B that are copied to stand together: a column of a large front is a page away from the next. Each
/// entry's sum is taken in the same order.
template <class Real>
void subtract_by_blocks(Real* c, std::ptrdiff_t stride, Block<Real> a, Block<Real> b, std::ptrdiff_t rows, int columns, int depth, bool below) {
  constexpr int kBlockRows = kBlockBytes / static_cast<int>(sizeof(Real));
  alignas(64) Real block[kBlockDepth * kBlockRows], factors[kBlockDepth * kBlockColumns];
  for (int k = 0; k < depth; k += kBlockDepth) {
    const int deep = depth - k < kBlockDepth ? depth - k : kBlockDepth;
    for (int j = 0; j < columns; j += kBlockColumns) {
      const int wide = columns - j < kBlockColumns ? columns - j : kBlockColumns;
      for (int m = 0; m < deep; ++m) {
        for (int n = 0; n < wide; ++n) factors[m * kBlockColumns + n] = b.at[(k + m) * b.stride + j + n];
      }
      for (std::ptrdiff_t r = below ? j - j % kBlockRows : 0; r < rows; r += kBlockRows) {
        const std::ptrdiff_t high = rows - r < kBlockRows ? rows - r : kBlockRows;
        for (int m = 0; m < deep; ++m) {
          for (std::ptrdiff_t n = 0; n < high; ++n) block[m * kBlockRows + n] = a.at[(k + m) * a.stride + r + n];
        }
        subtract_in_cache<Real>(c + j * stride + r, stride, {block, kBlockRows}, {factors, kBlockColumns}, high, wide, deep, below, j - r);
      }
    }
  }
}

template <class Real>
void subtract_product(Real* c, std::ptrdiff_t stride, Block<Real> a, Block<Real> b, std::ptrdiff_t rows, int columns, int depth, bool below) {
  if (depth == 0) return;
  if (rows * depth * static_cast<std::ptrdiff_t>(sizeof(Real)) > kFitsInCache && columns >= kFewColumns) {
    subtract_by_blocks(c, stride, a, b, rows, columns, depth, below);
  } else {
    subtract_in_cache(c, stride, a, b, rows, columns, depth, below, 0);
  }
}

template <class Real>
void subtract_multiple(Real* x, const Real* y, Real factor, std::ptrdiff_t from, std::ptrdiff_t to) {
  for (std::ptrdiff_t r = from; r < to; ++r) x[r] -= y[r] * factor;
}

/// Columns begin .. end - 1, which all before them have been taken out of. `upper` becomes D U^T.
template <class Real>
bool eliminate_columns(const DenseFront<Real>& f, int begin, int end) {
  for (int c = begin; c < end; ++c) {
    Real *l = f.lower + c * f.stride, *u = f.upper + c * f.stride;
    const Real pivot = l[c];
    if (!(pivot > 0 || pivot < 0)) return false;
    if (f.symmetric) {
      for (std::ptrdiff_t r = c; r < f.stride; ++r) u[r] = l[r];
    }
    const Real inverse = Real(1) / pivot;
    f.inverse_pivot[c] = inverse;
    for (std::ptrdiff_t r = c + 1; r < f.stride; ++r) l[r] *= inverse;
    for (int k = c + 1; k < end; ++k) {
      subtract_multiple(f.lower + k * f.stride, l, u[k], k, f.stride);
      if (!f.symmetric) subtract_multiple(f.upper + k * f.stride, u, l[k], k, f.stride);
    }
  }
  return true;
}

/// Columns that are taken out of those behind them together: all that come before are taken out of them in one product.
constexpr int kPanel = 64;

template <class Real>
bool eliminate_panel(const DenseFront<Real>& f, int begin, int end) {
  const std::ptrdiff_t s = f.stride;
  constexpr int width = Simd<Real>::width;  // so that the rows that are left are whole packs
  for (int c = begin; c < end; c += width) {
    const int n = end - c < width ? end - c : width;
    const Block<Real> lower{f.lower + begin * s + c, s}, upper{f.upper + begin * s + c, s};
    subtract_product(f.lower + c * s + c, s, lower, upper, s - c, n, c - begin, false);
    if (!f.symmetric) subtract_product(f.upper + c * s + c, s, upper, lower, s - c, n, c - begin, false);
    if (!eliminate_columns(f, c, c + n)) return false;
  }
  return true;
}

template <class Real>
bool eliminate(const DenseFront<Real>& f) {
  const std::ptrdiff_t s = f.stride;
  for (int c = 0; c < f.own; c += kPanel) {
    const int n = f.own - c < kPanel ? f.own - c : kPanel;
    const Block<Real> lower{f.lower + c, s}, upper{f.upper + c, s};
    subtract_product(f.lower + c * s + c, s, lower, upper, s - c, n, c, false);
    if (!f.symmetric) subtract_product(f.upper + c * s + c, s, upper, lower, s - c, n, c, false);
    if (!eliminate_panel(f, c, c + n)) return false;
  }
  const Block<Real> lower{f.lower + f.own, s}, upper{f.upper + f.own, s};
  subtract_product(f.schur, f.rest_stride, lower, upper, f.rest_stride, f.rest, f.own, f.symmetric);
  if (f.symmetric) return true;
  for (int c = 0; c < f.own; ++c) {
    for (std::ptrdiff_t r = c + 1; r < s; ++r) f.upper[c * s + r] *= f.inverse_pivot[c];
  }
  return true;
}

/// Four columns at a time, so that the right side is read and written a quarter as often.
template <class Real>
void forward(const DenseFront<Real>& f, const FrontColumns<Real>& x) {
  const std::ptrdiff_t s = f.stride;
  for (int c = 0; c < f.own; c += kColumns) {
    const int n = f.own - c < kColumns ? f.own - c : kColumns;
    const Real* l = f.lower + c * s;
    for (int m = 0; m < x.count; ++m) {
      Real* v = x.values + m * x.stride;
      for (int j = 0; j < n; ++j) subtract_multiple(v, l + j * s, v[c + j], c + j + 1, c + n);
      if (n < kColumns) {
        for (int j = 0; j < n; ++j) subtract_multiple(v, l + j * s, v[c + j], c + n, s);
        continue;
      }
      const Real a = v[c], b = v[c + 1], d = v[c + 2], e = v[c + 3];
      for (std::ptrdiff_t r = c + kColumns; r < s; ++r) v[r] = v[r] - l[r] * a - l[s + r] * b - l[2 * s + r] * d - l[3 * s + r] * e;
    }
  }
}

/// sum over the rows from `from` on of each of n columns times v.
template <int n, class Real>
[[gnu::always_inline]] inline void dot_columns(const Real* u, std::ptrdiff_t s, const Real* v, std::ptrdiff_t from, Real* dot) {
  constexpr int width = Simd<Real>::width;
  const std::ptrdiff_t whole = s - (s - from) / width * width;
  for (int j = 0; j < n; ++j) {
    dot[j] = 0;
    for (std::ptrdiff_t r = from; r < whole; ++r) dot[j] += u[j * s + r] * v[r];
  }
  typename Simd<Real>::Pack sum[n] = {};
  for (std::ptrdiff_t r = whole; r < s; r += width) {
    for (int j = 0; j < n; ++j) sum[j] += load(u + j * s + r) * load(v + r);
  }
  for (int j = 0; j < n; ++j) {
    for (int half = width / 2; half > 0; half /= 2) {
      for (int k = 0; k < half; ++k) sum[j][k] += sum[j][k + half];
    }
    dot[j] += sum[j][0];
  }
}

template <class Real>
void backward(const DenseFront<Real>& f, const FrontColumns<Real>& x) {
  const std::ptrdiff_t s = f.stride;
  const Real* upper = f.symmetric ? f.lower : f.upper;
  for (int end = f.own; end > 0;) {
    const int n = end >= kColumns ? kColumns : end, c = end - n;
    const Real* u = upper + c * s;
    for (int m = 0; m < x.count; ++m) {
      Real* v = x.values + m * x.stride;
      Real dot[kColumns];
      if (n == kColumns) {
        dot_columns<kColumns>(u, s, v, end, dot);
      } else {
        for (int j = 0; j < n; ++j) dot_columns<1>(u + j * s, s, v, end, dot + j);
      }
      for (int j = n - 1; j >= 0; --j) {
        Real value = v[c + j] * f.inverse_pivot[c + j] - dot[j];
        for (int k = j + 1; k < n; ++k) value -= u[j * s + c + k] * v[c + k];
        v[c + j] = value;
      }
    }
    end = c;
  }
}

}  // namespace

template <class Real>
FrontKernels<Real> front_kernels() { return {eliminate<Real>, forward<Real>, backward<Real>}; }

template FrontKernels<double> front_kernels<double>();
template FrontKernels<float> front_kernels<float>();

}  // namespace ddem::DDEM_ISA
