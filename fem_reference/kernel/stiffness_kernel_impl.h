// No include guard: the body of the kernel, included once by each stiffness_kernel_<set>.cc, which defines
// DDEM_KERNEL_TABLE. Nothing here may have external linkage but that table: a function compiled for AVX-512
// and shared by name could be the copy that the linker keeps for all.

#include "fem_reference/kernel/stiffness_kernel.h"

namespace ddem::fem {
namespace {

// One double per element of the batch; the compiler splits it into the registers that the set has.
typedef double Lanes __attribute__((vector_size(lanes * sizeof(double))));

// out(q, line) = sum_k D(q, k) in(k, line) along one direction of the element: `stride` between the points
// of a line.
template <int n, int stride>
inline __attribute__((always_inline)) void differentiate(const double* d, const Lanes* in, Lanes* out) {
  for (int q = 0; q < n; ++q) {
    Lanes sum = d[q * n] * in[0];
    for (int k = 1; k < n; ++k) sum += d[q * n + k] * in[k * stride];
    out[q * stride] = sum;
  }
}

// out(k, line) += scale sum_q D(q, k) w(q) in(q, line): the transpose, with the weights of the quadrature
// along the line; `dw` is w(q) D(q, k).
template <int n, int stride>
inline __attribute__((always_inline)) void integrate(const double* dw, double scale, const Lanes* in,
                                                     Lanes* out) {
  for (int k = 0; k < n; ++k) {
    Lanes sum = dw[k] * in[0];
    for (int q = 1; q < n; ++q) sum += dw[q * n + k] * in[q * stride];
    out[k * stride] += scale * sum;
  }
}

template <int n>
struct Element {
  Lanes u[2][n * n];         // displacement, later force
  Lanes slope[2][2][n * n];  // [component][direction], later stress
};

template <int n>
inline __attribute__((always_inline)) void gather(const std::uint32_t* nodes, const double* u,
                                                  Element<n>& e) {
  for (int point = 0; point < n * n; ++point) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const double* value = u + 2 * std::size_t{nodes[point * lanes + lane]};
      e.u[0][point][lane] = value[0];
      e.u[1][point][lane] = value[1];
    }
  }
}

template <int n>
inline __attribute__((always_inline)) void scatter(const std::uint32_t* nodes, const Element<n>& e,
                                                   double* f) {
  for (int point = 0; point < n * n; ++point) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      double* value = f + 2 * std::size_t{nodes[point * lanes + lane]};
      value[0] += e.u[0][point][lane];
      value[1] += e.u[1][point][lane];
    }
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
  if constexpr (shape == ElementShape::parallelogram) load(coefficients, c);
  for (int point = 0; point < n * n; ++point) {
    if constexpr (shape == ElementShape::general) load(coefficients + point * coefficients_per_element * lanes, c);
    const Lanes g0 = e.slope[0][0][point], g1 = e.slope[0][1][point];
    const Lanes g2 = e.slope[1][0][point], g3 = e.slope[1][1][point];
    e.slope[0][0][point] = c[0] * g0 + c[1] * g1 + c[2] * g2 + c[3] * g3;
    e.slope[0][1][point] = c[1] * g0 + c[4] * g1 + c[5] * g2 + c[6] * g3;
    e.slope[1][0][point] = c[2] * g0 + c[5] * g1 + c[7] * g2 + c[8] * g3;
    e.slope[1][1][point] = c[3] * g0 + c[6] * g1 + c[8] * g2 + c[9] * g3;
  }
}

// Sum factorisation: slopes along lines, stress at points, and the transpose back. u is overwritten by f.
template <int n, ElementShape shape>
void apply(const KernelData& data, const double* u, double* f) {
  double dw[n * n];
  for (int q = 0; q < n; ++q) {
    for (int k = 0; k < n; ++k) dw[q * n + k] = data.weights[q] * data.derivative[q * n + k];
  }
  Element<n> e;
  for (std::size_t batch = data.first_batch; batch < data.last_batch; ++batch) {
    const std::uint32_t* nodes = data.nodes + batch * n * n * lanes;
    gather<n>(nodes, u, e);
    for (int component = 0; component < 2; ++component) {
      for (int line = 0; line < n; ++line) {
        differentiate<n, 1>(data.derivative, e.u[component] + line * n, e.slope[component][0] + line * n);
        differentiate<n, n>(data.derivative, e.u[component] + line, e.slope[component][1] + line);
      }
    }
    constexpr std::size_t sets = shape == ElementShape::general ? n * n : 1;
    stress<n, shape>(data.coefficients + batch * sets * coefficients_per_element * lanes, e);
    for (int component = 0; component < 2; ++component) {
      for (int point = 0; point < n * n; ++point) e.u[component][point] = Lanes{};
      for (int line = 0; line < n; ++line) {
        const double weight = data.weights[line];
        integrate<n, 1>(dw, weight, e.slope[component][0] + line * n, e.u[component] + line * n);
        integrate<n, n>(dw, weight, e.slope[component][1] + line, e.u[component] + line);
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
const StiffnessKernel DDEM_KERNEL_TABLE[element_shapes][8] = {DDEM_DEGREES(ElementShape::parallelogram),
                                                              DDEM_DEGREES(ElementShape::general)};
#undef DDEM_DEGREES

}  // namespace ddem::fem
