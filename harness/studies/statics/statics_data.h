#pragma once
// What statics find of one material.

#include <optional>
#include <string>

#include "dem/statics/moduli.h"
#include "harness/references/effective_moduli.h"
#include "harness/run/scene_moduli.h"
#include "harness/studies/statics/bloch_limit.h"
#include "harness/studies/strip/material.h"

namespace ddem::harness {

/// References of one assembly and law, from static solves and closed forms.
struct StaticOutcome {
  StripMaterial key;
  std::string failure;  ///< empty: ok
  SceneModuli moduli;   ///< of the strip; bar from the pulled free strip
  Speeds speeds;        ///< static, directional
  Speeds sections;      ///< static, mean over the pairs of sections at which driven pulses are recorded; random packings only
  references::PlaneModuli kinematic;  ///< closed form: exact on the lattice, an estimate on a random packing
  Speeds kinematic_speeds;
  /// s; of rigid discs, edges closed above and below and no disc held: that of each wave's strip is as long or a little longer.
  double critical_time_step = 0.0;
  /// Hexagonal only: homogenised unit cell, to be compared with the closed form.
  std::optional<IsotropicModuli> cell;
  std::optional<BlochLimit> bloch;  ///< hexagonal only
  double solve_seconds = 0.0;       ///< wall time of the strip's moduli: both its edges, factorised and solved
};

DDEM_MEMBERS(SceneModuli, discs, bonds, rattlers, coordination, solid_fraction, bulk_density, moving_density, method, stiffness, strip)
DDEM_MEMBERS(BlochLimit, shear, p, seconds)
DDEM_MEMBERS(StaticOutcome, key, failure, moduli, speeds, sections, kinematic, kinematic_speeds, critical_time_step, cell, bloch, solve_seconds)

/// Throws std::runtime_error where members that belong together do not fit: a result of another program.
void require_whole(const StaticOutcome& found);

}  // namespace ddem::harness
