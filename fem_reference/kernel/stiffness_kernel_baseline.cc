#define DDEM_KERNEL_TABLE stiffness_kernels_baseline
#include "fem_reference/kernel/stiffness_kernel_impl.h"
