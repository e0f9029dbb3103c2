#pragma once
// Figure and verdicts of the study of dispersion.

#include "harness/studies/dispersion/dispersion_data.h"
#include "reports/figure.h"
#include "reports/verdict.h"

namespace ddem::harness {

/// Amplitude over wavenumber and frequency, a panel a system, with the exact branches.
reports::Figure dispersion_figure(const DispersionStudy& study);

/// The crests of each wave lie on its exact branch within 1 %, and every wavenumber has one.
reports::Verdict dispersion_verdict(const DispersionPanel& panel);

}  // namespace ddem::harness
