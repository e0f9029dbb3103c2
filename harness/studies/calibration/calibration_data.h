#pragma once
// Calibration as a part of a campaign: targets whose contacts are known in closed form or out of reach, and
// targets on random packings that must hold on packings which were not fitted.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "harness/campaign/run_options.h"
#include "harness/studies/strip/strip_campaign.h"
#include "reports/table.h"
#include "reports/verdict.h"

namespace ddem::harness {

/// A target for an assembly of the campaign: E = 30 GPa and this nu in the plane, bulk density 2400 kg/m3.
struct CalibrationCase {
  StripPacking packing = StripPacking::hexagonal;  ///< hexagonal: a cell of the infinite lattice
  Model model = Model::dem;
  double poisson_ratio = 0.0;
  std::optional<double> stiffness_ratio;  ///< held; else searched
};

std::vector<CalibrationCase> calibration_cases();
std::string id_of(const CalibrationCase& c);  ///< "calibration/random/dem/nu0.25"

/// Static moduli of one packing with the contacts found: seed (0 of the lattice), Pa.
struct CalibratedPacking {
  std::int64_t seed = 0;
  double young_modulus = 0.0, poisson_ratio = 0.0;
};

struct CalibrationOutcome {
  std::string id;       ///< of its case
  std::string failure;  ///< empty: ok
  double target_young = 0.0, target_poisson = 0.0;
  bool feasible = false;
  double stiffness_ratio = 0.0, normal_stiffness = 0.0;  ///< k_t/k_n; k_n, N/m
  double softness = 0.0, particle_poisson_ratio = 0.0;   ///< k_n/(E_p h), nu_p; 0 for rigid discs
  double highest_rigid = 0.0;                            ///< nu within reach of rigid discs
  std::optional<double> highest_implicit;                ///< and of implicit F, where the target is not
  std::vector<CalibratedPacking> fitted, unseen;         ///< measured anew, by the scene with these contacts
};

DDEM_MEMBERS(CalibratedPacking, seed, young_modulus, poisson_ratio)
DDEM_MEMBERS(CalibrationOutcome, id, failure, target_young, target_poisson, feasible, stiffness_ratio, normal_stiffness, softness,
             particle_poisson_ratio, highest_rigid, highest_implicit, fitted, unseen)

/// Half of as many packings as the campaign has seeds are fitted, from its first seed on, and those that
/// follow tell whether that holds. The options' disturbance is put into the scene that is measured. Throws
/// what calibrate() does.
CalibrationOutcome study_calibration(const StripCampaign& campaign, const CalibrationCase& c,
                                     const CampaignOptions& options);

/// Found contacts against the closed form (lattice), moduli against the target: of what was fitted within the
/// search's tolerance, of other packings within their scatter; a target out of reach must be refused.
reports::Verdict calibration_verdict(const CalibrationOutcome& outcome);

reports::Table calibration_table(const std::vector<CalibrationOutcome>& outcomes);

}  // namespace ddem::harness
