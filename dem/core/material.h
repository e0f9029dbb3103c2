#pragma once
// Parameters of the contacts and of the discs' material, and the compliance D of a disc.

namespace ddem {

enum class Kinematics {
  linear,    ///< small displacement: the geometry of the bonds is that of the start
  nonlinear  ///< current geometry, incremental shear, finite rotation
};

struct ContactParameters {
  double normal_stiffness = 0.0;  ///< k_n, N/m
  double stiffness_ratio = 0.0;   ///< k_t / k_n; at 0 the discs' rotations drop out
  Kinematics kinematics = Kinematics::linear;
  /// Where positive, it takes the place of normal_stiffness: k_n of a bond in proportion to its size (bond_stiffness.h), Pa.
  double contact_modulus = 0.0;

  bool uniform() const { return contact_modulus == 0.0; }
  double shear_stiffness() const { return stiffness_ratio * normal_stiffness; }
  bool has_rotation() const { return stiffness_ratio != 0.0; }
};

enum class Scheme {
  none,     ///< plain DEM
  lagged,   ///< the published scheme: the strains come from the forces of the step before
  implicit  ///< the strains are in equilibrium with the forces of the same step
};

/// Which overlaps the strain corrects and which forces make the stress (theory section 1).
enum class Correction {
  normal,             ///< N: normal overlap corrected; stress from normal and tangential forces (published)
  full,               ///< F: both corrected, symmetrised stress; derives from an energy
  normal_only_stress  ///< NN: normal overlap corrected, stress from normal forces; derives from an energy
};

enum class Plane { stress, strain };

/// Over which volume V_p the contact forces of a disc are averaged (sigma_p = (1/V_p) sum s (x) F).
enum class ParticleVolume {
  disc,  ///< of the disc itself (published)
  cell   ///< with its share of the voids: V_p over the solid fraction, so that the cells fill the assembly
};

/// How implicit strains are found.
enum class StrainSolver {
  polynomial,          ///< of fixed degree: symmetric, so that energy is conserved to round-off
  conjugate_gradients  ///< from the strains of the step before, to a residual: fewer iterations for soft discs
};

struct DeformationParameters {
  Scheme scheme = Scheme::none;
  Correction correction = Correction::normal;
  double young_modulus = 0.0;  ///< E_p of the disc, Pa
  double poisson_ratio = 0.0;  ///< nu_p of the disc
  Plane plane = Plane::stress;
  int evaluations = 1;       ///< lagged: force evaluations a step
  double relaxation = 1.0;   ///< lagged: weight of the new strain, the rest is that before
  /// implicit: largest relative error of the moduli against converged strains, and a hundredth of that of any stiffness,
  /// which never exceeds 0.01 (polynomial); or of the strains' residual (conjugate gradients).
  double tolerance = 1e-4;
  StrainSolver solver = StrainSolver::polynomial;
  ParticleVolume volume = ParticleVolume::disc;

  bool active() const { return scheme != Scheme::none; }
};

/// Isotropic compliance of a disc in the plane:
/// eps_xx = direct s_xx + coupling s_yy, eps_xy = shear s_xy (tensor components).
struct Compliance {
  double direct = 0.0, coupling = 0.0, shear = 0.0;  // 1/Pa
};

/// Plane strain replaces (E, nu) by (E/(1-nu^2), nu/(1-nu)); theory section 2.
inline Compliance disc_compliance(const DeformationParameters& p) {
  const bool strain = p.plane == Plane::strain;
  const double nu = strain ? p.poisson_ratio / (1.0 - p.poisson_ratio) : p.poisson_ratio;
  const double e = strain ? p.young_modulus / (1.0 - p.poisson_ratio * p.poisson_ratio) : p.young_modulus;
  return {1.0 / e, -nu / e, (1.0 + nu) / e};
}

}  // namespace ddem
