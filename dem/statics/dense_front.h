#pragma once
// Elimination in a dense matrix: what a sparse factorisation does at each of its fronts. The kernels are compiled once per
// instruction set, always with the same bits, and share no inline code with the rest of the program.

#include <cstddef>

#include "dem/kernel/step_data.h"

namespace ddem {

/// Numbers in a register of 64 bytes.
template <class Real>
inline constexpr std::ptrdiff_t kFrontPack = 64 / sizeof(Real);

/// Real: double or float. Columns are stored one after the other, `stride` apart, their rows first those of the unknowns to be eliminated, then
/// those of the rest. Rows up to the stride, which is a multiple of kFrontPack, are zero.
template <class Real>
struct DenseFront {
  int own = 0, rest = 0;
  std::ptrdiff_t stride = 0;       ///< at least own + rest_stride
  std::ptrdiff_t rest_stride = 0;  ///< rest, rounded up to a multiple of kFrontPack
  Real* lower = nullptr;           ///< `own` columns of A; becomes L, its unit diagonal not stored
  Real* upper = nullptr;           ///< `own` columns of A^T; becomes U^T, A = L D U. Symmetric: room for as much
  Real* schur = nullptr;           ///< rest x rest; what is left of it, A_22 - L_21 D U_12. Symmetric: below the diagonal
  Real* inverse_pivot = nullptr;   ///< D^-1
  bool symmetric = true;
};

/// Columns that a front solves for, `stride` apart: rows as the front's.
template <class Real>
struct FrontColumns {
  Real* values = nullptr;
  std::ptrdiff_t stride = 0;
  int count = 0;
};

template <class Real>
struct FrontKernels {
  /// Without exchange of rows. False where a pivot is zero or no number.
  bool (*eliminate)(const DenseFront<Real>&);
  /// x_1 <- L_11^-1 x_1, x_2 <- x_2 - L_21 x_1.
  void (*forward)(const DenseFront<Real>&, const FrontColumns<Real>&);
  /// x_1 <- U_11^-1 (D^-1 x_1 - U_12 x_2), U^T the front's `upper`, or its `lower` where symmetric.
  void (*backward)(const DenseFront<Real>&, const FrontColumns<Real>&);
};

/// For double and float.
template <class Real>
FrontKernels<Real> front_kernels(InstructionSet isa);

}  // namespace ddem
