#pragma once
// The figures and the table of the study of schemes.

#include "harness/studies/schemes/schemes_data.h"
#include "reports/figure.h"
#include "reports/table.h"

namespace ddem::harness {

/// Energy over time, Poisson's ratio reached over k_n/E_p, error over the time step.
reports::Figure scheme_figure(const SchemeStudy& study);
/// Cost a step, energy drift and order of each scheme.
reports::Table scheme_table(const SchemeStudy& study);

}  // namespace ddem::harness
