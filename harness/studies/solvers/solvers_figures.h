#pragma once
// Solvers side by side.

#include <span>

#include "harness/studies/solvers/solvers_data.h"
#include "reports/report.h"

namespace ddem::harness {

/// All laws of one solver, on both strips; `compared` is not empty, and of one label.
reports::Figure solver_figure(std::span<const ComparedSolver> compared);
reports::Table solver_table(std::span<const ComparedSolver> compared);

}  // namespace ddem::harness
