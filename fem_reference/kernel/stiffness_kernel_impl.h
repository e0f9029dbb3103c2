// No include guard: the body of the kernel, included once by each stiffness_kernel_<set>.cc, which defines
// DDEM_KERNEL_TABLE. Nothing here may have external linkage but that table: a function compiled for AVX-512
// and shared by name could be the copy that the linker keeps for all.

#include "fem_reference/kernel/stiffness_kernel.h"

namespace ddem::fem {
namespace {

// One double per element of the batch; the compiler splits it into the registers that the set has.
typedef double Lanes __attribute__((vector_size(lanes * sizeof(double))));

typedef double Pair __attribute__((vector_size(2 * sizeof(double))));
typedef double PairInMemory __attribute__((vector_size(2 * sizeof(double)), aligned(sizeof(double)), may_alias));
typedef double Quad __attribute__((vector_size(4 * sizeof(double))));

// How the loops over a line of points write their result.
enum class Write { set, add };

// out(q) = scale sum_k A(q, k) in(k) along one line of points, `stride` between them, A by its halves (Halves in
// elastic_operator.cc): with e = in(k) + in(n-1-k) and o = in(k) - in(n-1-k) the rows q and n-1-q share their products.
template <int n, int stride, Write write>
inline __attribute__((always_inline)) void multiply(const double* a, double scale, const Lanes* in, Lanes* out) {
  constexpr int half = n / 2, last = n - 1;
  Lanes even[half], odd[half];
#pragma GCC unroll 4
  for (int k = 0; k < half; ++k) {
    even[k] = in[k * stride] + in[(last - k) * stride];
    odd[k] = in[k * stride] - in[(last - k) * stride];
  }
  const auto store = [&](int q, const Lanes& value) {
    if constexpr (write == Write::set) {
      out[q * stride] = value;
    } else {
      out[q * stride] += scale * value;
    }
  };
#pragma GCC unroll 4
  for (int q = 0; q < half; ++q) {
    Lanes from_odd = a[half * half + q * half] * odd[0], from_even = a[q * half] * even[0];
#pragma GCC unroll 4
    for (int k = 1; k < half; ++k) {
      from_even += a[q * half + k] * even[k];
      from_odd += a[half * half + q * half + k] * odd[k];
    }
    if constexpr (n % 2 == 1) from_even += a[2 * half * half + half + q] * in[half * stride];
    store(q, from_odd + from_even);
    store(last - q, from_odd - from_even);
  }
  if constexpr (n % 2 == 1) {
    Lanes middle = a[2 * half * half] * odd[0];
#pragma GCC unroll 4
    for (int k = 1; k < half; ++k) middle += a[2 * half * half + k] * odd[k];
    store(half, middle);
  }
}

template <int n>
struct Element {
  Lanes u[2][n * n];         // displacement, later force
  Lanes slope[2][2][n * n];  // [component][direction], later stress
};

// Both components of a node lie side by side: they are moved together.
template <int n>
inline __attribute__((always_inline)) void gather(const std::uint32_t* nodes, const double* u,
                                                  Element<n>& e) {
  const auto pair = [&](std::uint32_t node) -> Pair { return *reinterpret_cast<const PairInMemory*>(u + 2 * std::size_t{node}); };
  const auto quad = [&](const std::uint32_t* two) {
    return __builtin_shufflevector(pair(two[0]), pair(two[1]), 0, 1, 2, 3);
  };
  for (int point = 0; point < n * n; ++point, nodes += lanes) {
    const Lanes low = __builtin_shufflevector(quad(nodes), quad(nodes + 2), 0, 1, 2, 3, 4, 5, 6, 7);
    const Lanes high = __builtin_shufflevector(quad(nodes + 4), quad(nodes + 6), 0, 1, 2, 3, 4, 5, 6, 7);
    e.u[0][point] = __builtin_shufflevector(low, high, 0, 2, 4, 6, 8, 10, 12, 14);
    e.u[1][point] = __builtin_shufflevector(low, high, 1, 3, 5, 7, 9, 11, 13, 15);
  }
}

// Lane after lane, since elements of a batch may share nodes.
template <int n>
inline __attribute__((always_inline)) void scatter(const std::uint32_t* nodes, const Element<n>& e,
                                                   double* f) {
  const auto add = [&](std::uint32_t node, const Pair& value) {
    *reinterpret_cast<PairInMemory*>(f + 2 * std::size_t{node}) += value;
  };
  for (int point = 0; point < n * n; ++point, nodes += lanes) {
    const Lanes x = e.u[0][point], y = e.u[1][point];
    add(nodes[0], __builtin_shufflevector(x, y, 0, 8));
    add(nodes[1], __builtin_shufflevector(x, y, 1, 9));
    add(nodes[2], __builtin_shufflevector(x, y, 2, 10));
    add(nodes[3], __builtin_shufflevector(x, y, 3, 11));
    add(nodes[4], __builtin_shufflevector(x, y, 4, 12));
    add(nodes[5], __builtin_shufflevector(x, y, 5, 13));
    add(nodes[6], __builtin_shufflevector(x, y, 6, 14));
    add(nodes[7], __builtin_shufflevector(x, y, 7, 15));
  }
}

inline __attribute__((always_inline)) void load(const double* coefficients, Lanes* c) {
  for (std::size_t k = 0; k < coefficients_per_element; ++k) {
    for (std::size_t lane = 0; lane < lanes; ++lane) c[k][lane] = coefficients[k * lanes + lane];
  }
}

// T = C g at every point: the Piola stress of the reference element from the slopes g along xi and eta.
template <int n, ElementShape shape>
inline __attribute__((always_inline)) void stress(const double* coefficients, Element<n>& e) {
  Lanes c[coefficients_per_element];
  if constexpr (shape != ElementShape::general) load(coefficients, c);
  for (int point = 0; point < n * n; ++point) {
    if constexpr (shape == ElementShape::general) load(coefficients + point * coefficients_per_element * lanes, c);
    const Lanes g0 = e.slope[0][0][point], g1 = e.slope[0][1][point];
    const Lanes g2 = e.slope[1][0][point], g3 = e.slope[1][1][point];
    if constexpr (shape == ElementShape::rectangle) {
      e.slope[0][0][point] = c[0] * g0 + c[3] * g3;
      e.slope[0][1][point] = c[4] * g1 + c[5] * g2;
      e.slope[1][0][point] = c[5] * g1 + c[7] * g2;
      e.slope[1][1][point] = c[3] * g0 + c[9] * g3;
      continue;
    }
    e.slope[0][0][point] = c[0] * g0 + c[1] * g1 + c[2] * g2 + c[3] * g3;
    e.slope[0][1][point] = c[1] * g0 + c[4] * g1 + c[5] * g2 + c[6] * g3;
    e.slope[1][0][point] = c[2] * g0 + c[5] * g1 + c[7] * g2 + c[8] * g3;
    e.slope[1][1][point] = c[3] * g0 + c[6] * g1 + c[8] * g2 + c[9] * g3;
  }
}

// Sum factorisation: slopes along lines, stress at points, and the transpose back. u is overwritten by f.
template <int n, ElementShape shape>
void apply(const KernelData& data, const double* u, double* f) {
  Element<n> e;
  for (std::size_t batch = data.first_batch; batch < data.last_batch; ++batch) {
    const std::uint32_t* nodes = data.nodes + batch * n * n * lanes;
    gather<n>(nodes, u, e);
    for (int component = 0; component < 2; ++component) {
      for (int line = 0; line < n; ++line) {
        multiply<n, 1, Write::set>(data.derivative, 1.0, e.u[component] + line * n, e.slope[component][0] + line * n);
        multiply<n, n, Write::set>(data.derivative, 1.0, e.u[component] + line, e.slope[component][1] + line);
      }
    }
    constexpr std::size_t sets = shape == ElementShape::general ? n * n : 1;
    stress<n, shape>(data.coefficients + batch * sets * coefficients_per_element * lanes, e);
    for (int component = 0; component < 2; ++component) {
      for (int point = 0; point < n * n; ++point) e.u[component][point] = Lanes{};
      for (int line = 0; line < n; ++line) {
        const double weight = data.weights[line];
        multiply<n, 1, Write::add>(data.divergence, weight, e.slope[component][0] + line * n, e.u[component] + line * n);
        multiply<n, n, Write::add>(data.divergence, weight, e.slope[component][1] + line, e.u[component] + line);
      }
    }
    scatter<n>(nodes, e, f);
  }
}

}  // namespace

// Row: shape; entry p - 1 is degree p.
#define DDEM_DEGREES(shape)                                                                        \
  {apply<2, shape>, apply<3, shape>, apply<4, shape>, apply<5, shape>,                             \
   apply<6, shape>, apply<7, shape>, apply<8, shape>, apply<9, shape>}
extern const StiffnessKernel DDEM_KERNEL_TABLE[element_shapes][8];
const StiffnessKernel DDEM_KERNEL_TABLE[element_shapes][8] = {DDEM_DEGREES(ElementShape::rectangle),
                                                              DDEM_DEGREES(ElementShape::parallelogram),
                                                              DDEM_DEGREES(ElementShape::general)};
#undef DDEM_DEGREES

}  // namespace ddem::fem
