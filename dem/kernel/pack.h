// Eight doubles that are worked on at once, one lane a disc: vector extensions, which the compiler turns into whatever
// the instruction set has, so that the bits are those of eight scalars everywhere. Include only from the kernels.
//
// What a bond reads of the other disc stands together in memory, four doubles a disc (kQuad): one load brings it, where
// a gather of each component would take eight. In registers it is a Triple, one Pack a component.

#include <cmath>
#include <cstdint>

#include "dem/kernel/step_data.h"

namespace ddem::DDEM_ISA {
namespace {

constexpr int kWidth = 8;  // kLanes

// A call between the loads and the sums of a bond would cost more than the bond.
#define DDEM_INLINE [[gnu::always_inline]] inline
#define DDEM_INLINE_LAMBDA __attribute__((always_inline))

using Pack = double __attribute__((vector_size(64)));

DDEM_INLINE Pack load(const double* p) { return *reinterpret_cast<const Pack*>(p); }
/// Into a register that stays: for every use the compiler would read memory again, a load as dear as a product.
DDEM_INLINE Pack load_once(const double* p) {
  Pack v = load(p);
#ifdef __AVX512F__
  asm("" : "+v"(v));
#endif
  return v;
}
DDEM_INLINE void store(double* p, Pack v) { *reinterpret_cast<Pack*>(p) = v; }
DDEM_INLINE Pack all(double x) { return Pack{x, x, x, x, x, x, x, x}; }

/// The value, but zero where x and y are both +0: one comparison, of their bits.
#ifdef __AVX512F__
DDEM_INLINE Pack unless_zero(Pack x, Pack y, Pack value) {
  using Bits = std::int64_t __attribute__((vector_size(64)));
  return (reinterpret_cast<Bits>(x) | reinterpret_cast<Bits>(y)) == 0 ? Pack{} : value;
}
#else
// By parts that registers hold: the compiler compares longer ones number by number.
template <int kFirst>
DDEM_INLINE auto part_unless_zero(Pack x, Pack y, Pack value) {
  const auto part = [](Pack v) DDEM_INLINE_LAMBDA {
#ifdef __AVX2__
    return __builtin_shufflevector(v, v, kFirst, kFirst + 1, kFirst + 2, kFirst + 3);
#else
    return __builtin_shufflevector(v, v, kFirst, kFirst + 1);
#endif
  };
  const auto c = part(value);
  using Bits = decltype(c == c);
  return (reinterpret_cast<Bits>(part(x)) | reinterpret_cast<Bits>(part(y))) == 0 ? decltype(part(value)){} : c;
}
DDEM_INLINE Pack unless_zero(Pack x, Pack y, Pack value) {
#ifdef __AVX2__
  return __builtin_shufflevector(part_unless_zero<0>(x, y, value), part_unless_zero<4>(x, y, value), 0, 1, 2, 3, 4, 5, 6, 7);
#else
  const auto a = part_unless_zero<0>(x, y, value), b = part_unless_zero<2>(x, y, value), c = part_unless_zero<4>(x, y, value),
             d = part_unless_zero<6>(x, y, value);
  return Pack{a[0], a[1], b[0], b[1], c[0], c[1], d[0], d[1]};
#endif
}
#endif

/// Of numbers that are not negative: their order is that of their bits, and the larger of two integers is one instruction. What
/// is no number counts as larger than all.
DDEM_INLINE Pack larger(Pack x, Pack y) {
  using Bits = std::int64_t __attribute__((vector_size(64)));
  const Bits a = reinterpret_cast<Bits>(x), b = reinterpret_cast<Bits>(y);
  return reinterpret_cast<Pack>(a > b ? a : b);
}

/// x x + y, fused where the instruction set has it: for bounds only, whose last bit no result depends on.
DDEM_INLINE Pack add_square(Pack x, Pack y) {
#ifdef __FMA__
  for (int l = 0; l < kWidth; ++l) y[l] = __builtin_fma(x[l], x[l], y[l]);
  return y;
#else
  return x * x + y;
#endif
}

DDEM_INLINE Pack square_root(Pack v) {
  for (int l = 0; l < kWidth; ++l) v[l] = std::sqrt(v[l]);
  return v;
}

/// u_x, u_y, theta of eight discs, or eps_xx, eps_yy, eps_xy.
struct Triple {
  Pack a, b, c;
};

#ifdef __AVX512F__
using Quad = double __attribute__((vector_size(32)));

DDEM_INLINE Pack join(Quad low, Quad high) { return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7); }
DDEM_INLINE Pack even(Pack x, Pack y) { return __builtin_shufflevector(x, y, 0, 8, 2, 10, 4, 12, 6, 14); }
DDEM_INLINE Pack odd(Pack x, Pack y) { return __builtin_shufflevector(x, y, 1, 9, 3, 11, 5, 13, 7, 15); }
DDEM_INLINE Pack first_halves(Pack x, Pack y) { return __builtin_shufflevector(x, y, 0, 1, 4, 5, 8, 9, 12, 13); }
DDEM_INLINE Pack second_halves(Pack x, Pack y) { return __builtin_shufflevector(x, y, 2, 3, 6, 7, 10, 11, 14, 15); }

/// A transposition of 8 x 4 doubles; disc(l) points to those of lane l.
template <class Disc>
DDEM_INLINE Triple transpose(Disc disc) {
  const auto quad = [&disc](int l) DDEM_INLINE_LAMBDA { return *reinterpret_cast<const Quad*>(disc(l)); };
  const Pack p02 = join(quad(0), quad(2)), p13 = join(quad(1), quad(3)), p46 = join(quad(4), quad(6)), p57 = join(quad(5), quad(7));
  const Pack ac = even(p02, p13), ac4 = even(p46, p57);  // a0 a1 c0 c1 a2 a3 c2 c3, and 4 to 7
  return {first_halves(ac, ac4), first_halves(odd(p02, p13), odd(p46, p57)), second_halves(ac, ac4)};
}

/// The transposition back: put(l, m, pair) takes the four doubles of the lanes l and m, the last of which is 0.
template <class Put>
DDEM_INLINE void transpose_back(const Triple& t, Put put) {
  const Pack ab_even = even(t.a, t.b), ab_odd = odd(t.a, t.b), c_even = even(t.c, Pack{}), c_odd = odd(t.c, Pack{});
  put(0, 2, __builtin_shufflevector(ab_even, c_even, 0, 1, 8, 9, 2, 3, 10, 11));
  put(4, 6, __builtin_shufflevector(ab_even, c_even, 4, 5, 12, 13, 6, 7, 14, 15));
  put(1, 3, __builtin_shufflevector(ab_odd, c_odd, 0, 1, 8, 9, 2, 3, 10, 11));
  put(5, 7, __builtin_shufflevector(ab_odd, c_odd, 4, 5, 12, 13, 6, 7, 14, 15));
}
DDEM_INLINE Quad low(Pack pair) { return __builtin_shufflevector(pair, pair, 0, 1, 2, 3); }
DDEM_INLINE Quad high(Pack pair) { return __builtin_shufflevector(pair, pair, 4, 5, 6, 7); }

DDEM_INLINE void store_triple(double* base, int p, const Triple& t) {
  transpose_back(t, [base, p](int l, int m, Pack pair) DDEM_INLINE_LAMBDA {
    *reinterpret_cast<Quad*>(base + kQuad * (p + l)) = low(pair);
    *reinterpret_cast<Quad*>(base + kQuad * (p + m)) = high(pair);
  });
}
DDEM_INLINE void add_triple(double* base, int p, const Triple& t) {
  transpose_back(t, [base, p](int l, int m, Pack pair) DDEM_INLINE_LAMBDA {
    *reinterpret_cast<Quad*>(base + kQuad * (p + l)) += low(pair);
    *reinterpret_cast<Quad*>(base + kQuad * (p + m)) += high(pair);
  });
}
#else
// By halves of four, of which a register of AVX2 holds one, and of two, which every processor loads at once: half the
// instructions to compile of number by number. A half is taken and set by its bytes: g++ splits a shuffle of eight into
// numbers.
using Duo = double __attribute__((vector_size(16)));
using Quad = double __attribute__((vector_size(32)));

DDEM_INLINE Quad join(Duo low, Duo high) { return __builtin_shufflevector(low, high, 0, 1, 2, 3); }
DDEM_INLINE Pack join(Quad low, Quad high) {
  Pack v;
  __builtin_memcpy(&v, &low, sizeof low);
  __builtin_memcpy(reinterpret_cast<char*>(&v) + sizeof low, &high, sizeof high);
  return v;
}
DDEM_INLINE Duo low(Quad q) { return __builtin_shufflevector(q, q, 0, 1); }
DDEM_INLINE Duo high(Quad q) { return __builtin_shufflevector(q, q, 2, 3); }
template <int kFirst>
DDEM_INLINE Quad four(const Pack& v) {
  Quad q;
  __builtin_memcpy(&q, reinterpret_cast<const char*>(&v) + kFirst * sizeof(double), sizeof q);
  return q;
}
DDEM_INLINE Quad even(Quad x, Quad y) { return __builtin_shufflevector(x, y, 0, 4, 2, 6); }
DDEM_INLINE Quad odd(Quad x, Quad y) { return __builtin_shufflevector(x, y, 1, 5, 3, 7); }

/// A transposition of 8 x 4 doubles; disc(l) points to those of lane l.
template <class Disc>
DDEM_INLINE Triple transpose(Disc disc) {
  const auto lanes = [&disc](int l, int m, int from) DDEM_INLINE_LAMBDA {
    return join(*reinterpret_cast<const Duo*>(disc(l) + from), *reinterpret_cast<const Duo*>(disc(m) + from));
  };
  const Quad ab02 = lanes(0, 2, 0), ab13 = lanes(1, 3, 0), ab46 = lanes(4, 6, 0), ab57 = lanes(5, 7, 0);
  return {join(even(ab02, ab13), even(ab46, ab57)), join(odd(ab02, ab13), odd(ab46, ab57)),
          join(even(lanes(0, 2, 2), lanes(1, 3, 2)), even(lanes(4, 6, 2), lanes(5, 7, 2)))};
}

/// The transposition back: put(l, ab, c) takes the four doubles of lane l, the last of which is 0.
template <class Put>
DDEM_INLINE void transpose_back(const Triple& t, Put put) {
  const auto put_four = [put](int l, Quad a, Quad b, Quad c) DDEM_INLINE_LAMBDA {
    const Quad ab02 = even(a, b), ab13 = odd(a, b), c02 = even(c, Quad{}), c13 = odd(c, Quad{});
    put(l, low(ab02), low(c02));
    put(l + 1, low(ab13), low(c13));
    put(l + 2, high(ab02), high(c02));
    put(l + 3, high(ab13), high(c13));
  };
  put_four(0, four<0>(t.a), four<0>(t.b), four<0>(t.c));
  put_four(4, four<4>(t.a), four<4>(t.b), four<4>(t.c));
}

DDEM_INLINE void store_triple(double* base, int p, const Triple& t) {
  transpose_back(t, [base, p](int l, Duo ab, Duo c) DDEM_INLINE_LAMBDA {
    double* disc = base + kQuad * (p + l);
    *reinterpret_cast<Duo*>(disc) = ab;
    *reinterpret_cast<Duo*>(disc + 2) = c;
  });
}
DDEM_INLINE void add_triple(double* base, int p, const Triple& t) {
  transpose_back(t, [base, p](int l, Duo ab, Duo c) DDEM_INLINE_LAMBDA {
    double* disc = base + kQuad * (p + l);
    *reinterpret_cast<Duo*>(disc) += ab;
    *reinterpret_cast<Duo*>(disc + 2) += c;
  });
}
#endif

/// Of the discs p .. p + 7, and of any eight discs.
DDEM_INLINE Triple load_triple(const double* base, int p) {
  return transpose([=](int l) DDEM_INLINE_LAMBDA { return base + kQuad * (p + l); });
}
DDEM_INLINE Triple gather(const double* base, const std::int32_t* disc) {
  return transpose([=](int l) DDEM_INLINE_LAMBDA { return base + kQuad * static_cast<std::ptrdiff_t>(disc[l]); });
}

/// One double from each of eight places.
DDEM_INLINE Pack gather_each(const double* base, const std::int32_t* at) {
  return Pack{base[at[0]], base[at[1]], base[at[2]], base[at[3]], base[at[4]], base[at[5]], base[at[6]], base[at[7]]};
}

}  // namespace
}  // namespace ddem::DDEM_ISA
