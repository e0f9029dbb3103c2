// The one place where the processor chooses a kernel.
#include "dem/statics/dense_front.h"

namespace ddem {

namespace baseline {
template <class Real>
FrontKernels<Real> front_kernels();
}
#ifdef DDEM_X86_KERNELS
namespace avx2 {
template <class Real>
FrontKernels<Real> front_kernels();
}
namespace avx512 {
template <class Real>
FrontKernels<Real> front_kernels();
}
#endif

template <class Real>
FrontKernels<Real> front_kernels(InstructionSet isa) {
#ifdef DDEM_X86_KERNELS
  if (isa == InstructionSet::avx512) return avx512::front_kernels<Real>();
  if (isa == InstructionSet::avx2) return avx2::front_kernels<Real>();
#endif
  (void)isa;
  return baseline::front_kernels<Real>();
}

template FrontKernels<double> front_kernels<double>(InstructionSet);
template FrontKernels<float> front_kernels<float>(InstructionSet);

}  // namespace ddem
