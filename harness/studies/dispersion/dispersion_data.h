#pragma once
// Which waves travel: frequency-wavenumber spectra of discs and of the continuum side by side, against exact branches.
//
// A strip of the lattice, periodic across, close-packed rows across it, so that columns of discs move alike; the first
// column is displaced, along the strip and across it, and let go: its sharp edge holds P and shear waves of all lengths.
// Free ends reflect them, which adds waves of the same branches. The continuum has the closed-form moduli of the lattice,
// and straight branches. With free edges above and below it carries the S0 wave of Rayleigh and Lamb.

#include <string>
#include <vector>

#include "harness/solvers/solver.h"
#include "harness/studies/strip/strip_campaign.h"
#include "harness/measure/fk_spectrum.h"

namespace ddem::harness {

/// A branch of one wave, sampled at the spectrum's wavenumbers, and the crests that were found.
struct DispersionBranch {
  std::string wave;                      ///< "P", "shear", "S0"
  std::vector<double> wavenumber, exact;  ///< 1/m, rad/s
  std::vector<RidgePoint> ridge;         ///< of the wavenumbers that are judged
  int expected = 0;                      ///< wavenumbers that are judged: from 8 waves over the strip to half the zone boundary

  /// Largest |frequency / exact - 1| of the ridge; infinite without one.
  double worst_deviation() const;
};

struct DispersionPanel {
  std::string system;   ///< "DEM", "DDEM F implicit", "DDEM F", "finite elements", "finite elements, free edges"
  std::string slug;
  std::string failure;  ///< empty: ok
  /// Of all components together, coarse as it is shown: the largest amplitude of each band of frequencies up to
  /// highest_frequency(); empty where it failed. Crests are found in the whole one.
  FkSpectrum spectrum;
  std::vector<DispersionBranch> branches;
};

struct DispersionStudy {
  double zone_boundary = 0.0;  ///< pi over the spacing of columns, 1/m
  std::vector<DispersionPanel> panels;
};

DDEM_MEMBERS(RidgePoint, wavenumber, frequency, amplitude)
DDEM_MEMBERS(FkSpectrum, wavenumber, frequency, amplitude)
DDEM_MEMBERS(DispersionBranch, wave, wavenumber, exact, ridge, expected)
DDEM_MEMBERS(DispersionPanel, system, slug, failure, spectrum, branches)
DDEM_MEMBERS(DispersionStudy, zone_boundary, panels)

/// Throws std::runtime_error where members that belong together do not fit: a result of another program.
void require_whole(const DispersionStudy& found);

/// That all panels are shown up to, rad/s: a little above the branches of rigid discs.
double highest_frequency(const DispersionStudy& study);

/// The panels, nothing measured yet.
DispersionStudy plan_dispersion(bool with_fem);

/// k_t/k_n = 0.3, discs of the campaign. `with_fem`: the continuum too. Deterministic.
DispersionStudy study_dispersion(const StripCampaign& campaign, bool with_fem, const Solver& solver = builtin_solver());

}  // namespace ddem::harness
