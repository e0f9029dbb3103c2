#pragma once
// The element loop of f = K u: batches of `lanes` elements, one element a lane, structure of arrays. The same
// source is compiled once for each instruction set; lanes never mix and contraction is off, so all of them
// give the same bits.

#include <cstddef>
#include <cstdint>

namespace ddem::fem {

inline constexpr std::size_t lanes = 8;
/// Upper triangle of the symmetric 4 x 4 matrix of an element or of one of its points; see ElasticOperator.
inline constexpr std::size_t coefficients_per_element = 10;

struct KernelData {
  std::size_t first_batch = 0, last_batch = 0;  ///< of those to do, the last one excluded
  const std::uint32_t* nodes = nullptr;  ///< [batch][point][lane]
  const double* coefficients = nullptr;  ///< [batch][coefficient][lane], or [batch][point][coefficient][lane]
  // Matrices with A(n-1-q, n-1-k) = -A(q, k), n = degree + 1, by their halves: see elastic_operator.cc.
  const double* derivative = nullptr;  ///< D(q, k) = GaussLobatto::derivative
  const double* divergence = nullptr;  ///< w(q) D(q, k), transposed
  const double* weights = nullptr;       ///< degree + 1
};

/// Adds K u to `f`; both are interleaved (ux, uy of node 0, of node 1, ...). One thread, batches in order.
using StiffnessKernel = void (*)(const KernelData& data, const double* u, double* f);

enum class InstructionSet { baseline, avx2, avx512 };

bool is_available(InstructionSet set);
/// The widest one of this processor.
InstructionSet best_instruction_set();
/// Whether an element's coefficients hold for all of its points (rectangle, parallelogram); of rectangles along x and y
/// entries 0, 3, 4, 5, 7 and 9 alone are not zero.
enum class ElementShape { rectangle, parallelogram, general };
inline constexpr int element_shapes = 3;

/// The one dispatch over degree (1..8), shape and instruction set. Throws std::invalid_argument for a degree or
/// an instruction set that is not there.
StiffnessKernel stiffness_kernel(int degree, ElementShape shape, InstructionSet set);

}  // namespace ddem::fem
