// Compiled once per instruction set: see dem/CMakeLists.txt.
#include "dem/kernel/step_kernel.h"
