// Compiled once per instruction set: see dem/CMakeLists.txt. Every sum is taken in the same order whatever the set.
#include "dem/statics/dense_front.h"

namespace ddem::DDEM_ISA {
namespace {

constexpr int kWidth = 8, kColumns = 4;
#ifdef __AVX512F__
constexpr int kPacks = 2;  // rows of a tile in packs: as many as the registers hold
#else
constexpr int kPacks = 1;
#endif

using Pack = double __attribute__((vector_size(64)));
typedef double InMemory __attribute__((vector_size(64), aligned(8), may_alias));  // wherever it starts (of a using clang takes no alignment)

[[gnu::always_inline]] inline Pack load(const double* p) { return *reinterpret_cast<const InMemory*>(p); }
[[gnu::always_inline]] inline void store(double* p, Pack v) { *reinterpret_cast<InMemory*>(p) = v; }

/// Columns of equal stride.
struct Block {
  const double* at;
  std::ptrdiff_t stride;
};

/// C -= A B^T for a tile of C, the sum over `depth` in registers.
template <int packs, int columns>
[[gnu::always_inline]] inline void subtract_tile(double* c, std::ptrdiff_t stride, Block from, Block factors, int depth) {
  const double *a = from.at, *b = factors.at;
  Pack sum[columns][packs];
  for (int j = 0; j < columns; ++j) {
    for (int p = 0; p < packs; ++p) sum[j][p] = load(c + j * stride + p * kWidth);
  }
  for (int k = 0; k < depth; ++k, a += from.stride, b += factors.stride) {
    for (int j = 0; j < columns; ++j) {
      for (int p = 0; p < packs; ++p) sum[j][p] -= load(a + p * kWidth) * b[j];
    }
  }
  for (int j = 0; j < columns; ++j) {
    for (int p = 0; p < packs; ++p) store(c + j * stride + p * kWidth, sum[j][p]);
  }
}

/// The rows of `columns` columns, a multiple of 8 of them.
template <int columns>
void subtract_columns(double* c, std::ptrdiff_t stride, Block a, Block b, std::ptrdiff_t rows, int depth) {
  std::ptrdiff_t r = 0;
  for (; r + kPacks * kWidth <= rows; r += kPacks * kWidth) subtract_tile<kPacks, columns>(c + r, stride, {a.at + r, a.stride}, b, depth);
  for (; r < rows; r += kWidth) subtract_tile<1, columns>(c + r, stride, {a.at + r, a.stride}, b, depth);
}

/// C -= A B^T; `below`: only what is not above the diagonal of C is asked for.
void subtract_product(double* c, std::ptrdiff_t stride, Block a, Block b, std::ptrdiff_t rows, int columns, int depth, bool below) {
  if (depth == 0) return;
  for (int j = 0; j < columns; j += kColumns) {
    const std::ptrdiff_t first = below ? j - j % kWidth : 0;
    double* const to = c + j * stride + first;
    const Block from{a.at + first, a.stride}, factors{b.at + j, b.stride};
    switch (columns - j) {
      case 1: subtract_columns<1>(to, stride, from, factors, rows - first, depth); break;
      case 2: subtract_columns<2>(to, stride, from, factors, rows - first, depth); break;
      case 3: subtract_columns<3>(to, stride, from, factors, rows - first, depth); break;
      default: subtract_columns<kColumns>(to, stride, from, factors, rows - first, depth);
    }
  }
}

void subtract_multiple(double* x, const double* y, double factor, std::ptrdiff_t from, std::ptrdiff_t to) {
  for (std::ptrdiff_t r = from; r < to; ++r) x[r] -= y[r] * factor;
}

/// Columns begin .. end - 1, which all before them have been taken out of. `upper` becomes D U^T.
bool eliminate_columns(const DenseFront& f, int begin, int end) {
  for (int c = begin; c < end; ++c) {
    double *l = f.lower + c * f.stride, *u = f.upper + c * f.stride;
    const double pivot = l[c];
    if (!(pivot > 0.0 || pivot < 0.0)) return false;
    if (f.symmetric) {
      for (std::ptrdiff_t r = c; r < f.stride; ++r) u[r] = l[r];
    }
    const double inverse = 1.0 / pivot;
    f.inverse_pivot[c] = inverse;
    for (std::ptrdiff_t r = c + 1; r < f.stride; ++r) l[r] *= inverse;
    for (int k = c + 1; k < end; ++k) {
      subtract_multiple(f.lower + k * f.stride, l, u[k], k, f.stride);
      if (!f.symmetric) subtract_multiple(f.upper + k * f.stride, u, l[k], k, f.stride);
    }
  }
  return true;
}

bool eliminate(const DenseFront& f) {
  const std::ptrdiff_t s = f.stride;
  for (int c = 0; c < f.own; c += kWidth) {
    const int n = f.own - c < kWidth ? f.own - c : kWidth;
    const Block lower{f.lower + c, s}, upper{f.upper + c, s};
    subtract_product(f.lower + c * s + c, s, lower, upper, s - c, n, c, false);
    if (!f.symmetric) subtract_product(f.upper + c * s + c, s, upper, lower, s - c, n, c, false);
    if (!eliminate_columns(f, c, c + n)) return false;
  }
  subtract_product(f.schur, f.rest_stride, {f.lower + f.own, s}, {f.upper + f.own, s}, f.rest_stride, f.rest, f.own, f.symmetric);
  if (f.symmetric) return true;
  for (int c = 0; c < f.own; ++c) {
    for (std::ptrdiff_t r = c + 1; r < s; ++r) f.upper[c * s + r] *= f.inverse_pivot[c];
  }
  return true;
}

/// Four columns at a time, so that the right side is read and written a quarter as often.
void forward(const DenseFront& f, const FrontColumns& x) {
  const std::ptrdiff_t s = f.stride;
  for (int c = 0; c < f.own; c += kColumns) {
    const int n = f.own - c < kColumns ? f.own - c : kColumns;
    const double* l = f.lower + c * s;
    for (int m = 0; m < x.count; ++m) {
      double* v = x.values + m * x.stride;
      for (int j = 0; j < n; ++j) subtract_multiple(v, l + j * s, v[c + j], c + j + 1, c + n);
      if (n < kColumns) {
        for (int j = 0; j < n; ++j) subtract_multiple(v, l + j * s, v[c + j], c + n, s);
        continue;
      }
      const double a = v[c], b = v[c + 1], d = v[c + 2], e = v[c + 3];
      for (std::ptrdiff_t r = c + kColumns; r < s; ++r) v[r] = v[r] - l[r] * a - l[s + r] * b - l[2 * s + r] * d - l[3 * s + r] * e;
    }
  }
}

/// sum over the rows from `from` on of each of n columns times v.
template <int n>
[[gnu::always_inline]] inline void dot_columns(const double* u, std::ptrdiff_t s, const double* v, std::ptrdiff_t from, double* dot) {
  const std::ptrdiff_t whole = s - (s - from) / kWidth * kWidth;
  for (int j = 0; j < n; ++j) {
    dot[j] = 0.0;
    for (std::ptrdiff_t r = from; r < whole; ++r) dot[j] += u[j * s + r] * v[r];
  }
  Pack sum[n] = {};
  for (std::ptrdiff_t r = whole; r < s; r += kWidth) {
    for (int j = 0; j < n; ++j) sum[j] += load(u + j * s + r) * load(v + r);
  }
  for (int j = 0; j < n; ++j) {
    const Pack& t = sum[j];
    dot[j] += ((t[0] + t[4]) + (t[2] + t[6])) + ((t[1] + t[5]) + (t[3] + t[7]));
  }
}

void backward(const DenseFront& f, const FrontColumns& x) {
  const std::ptrdiff_t s = f.stride;
  const double* upper = f.symmetric ? f.lower : f.upper;
  for (int end = f.own; end > 0;) {
    const int n = end >= kColumns ? kColumns : end, c = end - n;
    const double* u = upper + c * s;
    for (int m = 0; m < x.count; ++m) {
      double* v = x.values + m * x.stride;
      double dot[kColumns];
      if (n == kColumns) {
        dot_columns<kColumns>(u, s, v, end, dot);
      } else {
        for (int j = 0; j < n; ++j) dot_columns<1>(u + j * s, s, v, end, dot + j);
      }
      for (int j = n - 1; j >= 0; --j) {
        double value = v[c + j] * f.inverse_pivot[c + j] - dot[j];
        for (int k = j + 1; k < n; ++k) value -= u[j * s + c + k] * v[c + k];
        v[c + j] = value;
      }
    }
    end = c;
  }
}

}  // namespace

FrontKernels front_kernels() { return {eliminate, forward, backward}; }

}  // namespace ddem::DDEM_ISA
