#define DDEM_KERNEL_TABLE stiffness_kernels_avx2
#include "fem_reference/kernel/stiffness_kernel_impl.h"
