#pragma once
// Whether a solver agrees with the built-in one, and with the continuum.

#include "harness/studies/solvers/solvers_data.h"
#include "reports/verdict.h"

namespace ddem::harness {

reports::Verdict solver_verdict(const ComparedSolver& compared);

}  // namespace ddem::harness
