#include "fem_reference/kernel/stiffness_kernel.h"

#include <stdexcept>
#include <string>

#include "fem_reference/kernel/gauss_lobatto.h"

namespace ddem::fem {

extern const StiffnessKernel stiffness_kernels_baseline[element_shapes][8];
#ifdef DDEM_FEM_X86_KERNELS
extern const StiffnessKernel stiffness_kernels_avx2[element_shapes][8];
extern const StiffnessKernel stiffness_kernels_avx512[element_shapes][8];
#endif

bool is_available(InstructionSet set) {
  switch (set) {
    case InstructionSet::baseline:
      return true;
#ifdef DDEM_FEM_X86_KERNELS
    case InstructionSet::avx2:
      return __builtin_cpu_supports("avx2") != 0;
    case InstructionSet::avx512:
      return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
             __builtin_cpu_supports("avx512vl") != 0;
#endif
    default:
      return false;
  }
}

InstructionSet best_instruction_set() {
  if (is_available(InstructionSet::avx512)) return InstructionSet::avx512;
  if (is_available(InstructionSet::avx2)) return InstructionSet::avx2;
  return InstructionSet::baseline;
}

StiffnessKernel stiffness_kernel(int degree, ElementShape shape, InstructionSet set) {
  if (degree < 1 || degree > max_degree) {
    throw std::invalid_argument("no kernel of degree " + std::to_string(degree));
  }
  if (!is_available(set)) throw std::invalid_argument("the processor lacks this instruction set");
  const int row = static_cast<int>(shape);
#ifdef DDEM_FEM_X86_KERNELS
  if (set == InstructionSet::avx512) return stiffness_kernels_avx512[row][degree - 1];
  if (set == InstructionSet::avx2) return stiffness_kernels_avx2[row][degree - 1];
#endif
  return stiffness_kernels_baseline[row][degree - 1];
}

}  // namespace ddem::fem
