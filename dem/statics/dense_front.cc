// The one place where the processor chooses a kernel.
#include "dem/statics/dense_front.h"

namespace ddem {

namespace baseline {
FrontKernels front_kernels();
}
#ifdef DDEM_X86_KERNELS
namespace avx2 {
FrontKernels front_kernels();
}
namespace avx512 {
FrontKernels front_kernels();
}
#endif

FrontKernels front_kernels(InstructionSet isa) {
#ifdef DDEM_X86_KERNELS
  if (isa == InstructionSet::avx512) return avx512::front_kernels();
  if (isa == InstructionSet::avx2) return avx2::front_kernels();
#endif
  (void)isa;
  return baseline::front_kernels();
}

}  // namespace ddem
