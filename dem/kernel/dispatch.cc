// The one place where the scene's features and the processor choose a kernel.
#include "dem/kernel/step_data.h"

namespace ddem {

namespace baseline {
StepKernels choose(const StepFeatures&);
}
#ifdef DDEM_X86_KERNELS
namespace avx2 {
StepKernels choose(const StepFeatures&);
}
namespace avx512 {
StepKernels choose(const StepFeatures&);
}
#endif

InstructionSet best_instruction_set() {
#ifdef DDEM_X86_KERNELS
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd")) {
    return InstructionSet::avx512;
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2")) {
    return InstructionSet::avx2;
  }
#endif
  return InstructionSet::baseline;
}

StepKernels step_kernels(const StepFeatures& features, InstructionSet isa) {
#ifdef DDEM_X86_KERNELS
  if (isa == InstructionSet::avx512) return avx512::choose(features);
  if (isa == InstructionSet::avx2) return avx2::choose(features);
#endif
  (void)isa;
  return baseline::choose(features);
}

}  // namespace ddem
