#pragma once
// What the report compares with: every reference by its formula, its source, and where it is used.

#include "reports/report.h"

namespace ddem::harness {

reports::Section formulas_section();

}  // namespace ddem::harness
