#pragma once
// Static moduli and wave speeds of a scene's assembly: `ddem moduli`, and the reference of every measured speed.

#include <optional>
#include <string>

#include "dem/statics/moduli.h"
#include "harness/references/plane_elasticity.h"
#include "harness/scene/scene.h"

namespace ddem::harness {

struct SceneModuli {
  int discs = 0, bonds = 0, rattlers = 0;
  double coordination = 0.0;    ///< 2 bonds / discs
  double solid_fraction = 0.0, bulk_density = 0.0;  ///< of all discs
  double moving_density = 0.0;  ///< of the network whose stiffness it is: what waves move
  std::string method;           ///< how the stiffness was computed, or why there is none, in words
  /// Homogenised; empty for a free strip that cannot be closed above and below.
  std::optional<PlaneStiffness> stiffness;
  std::optional<StripTension> strip;  ///< where top and bottom are free: the very strip, pulled

  std::optional<IsotropicModuli> isotropic() const;
  std::optional<DirectionalSpeeds> speeds() const;  ///< bar from the pulled strip, where there is one
  /// The static speed of a wave along x: shear; longitudinal between periodic edges (P) or free ones (bar).
  std::optional<double> speed_of(Wave wave, bool periodic) const;
};

/// Throws InputError (scene), SolverError (no static equilibrium).
SceneModuli scene_moduli(const Scene& scene);
/// The strip of such a scene, or its laterally closed counterpart, in grips.
GrippedStrip gripped(const Scene& scene, const ddem::Assembly& assembly);
/// The moduli where the caller has the scene's strip between free edges in grips, and its laterally closed counterpart.
SceneModuli scene_moduli(const GrippedStrip& strip, const GrippedStrip& closed);

/// The kinematic (Voigt) estimate of the same assembly: closed forms of theory section 2, exact on the lattice.
references::PlaneModuli kinematic_moduli(const Scene& scene, const ddem::Assembly& assembly);

/// Kinematic estimate of the speed of that wave: cheap, and 0 to 25 % too high on random packings.
double kinematic_speed(const Scene& scene, const ddem::Assembly& assembly, Wave wave);

}  // namespace ddem::harness
