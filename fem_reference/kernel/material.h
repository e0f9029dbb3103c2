#pragma once
// Plane isotropic elasticity: sigma_ij = lame_lambda delta_ij eps_kk + 2 shear_modulus eps_ij, i, j in the
// plane.

namespace ddem::fem {

enum class Plane { stress, strain };

struct PlaneMaterial {
  double lame_lambda = 0.0;    ///< Pa: K - G of the plane
  double shear_modulus = 0.0;  ///< Pa
  double density = 0.0;        ///< kg/m3
};

/// `young_modulus` in Pa and `poisson_ratio` are the solid's; plane stress gives plane moduli equal to them
/// (2K = E/(1-nu), 2G = E/(1+nu)), plane strain those of E/(1-nu^2), nu/(1-nu). A plane medium that is no
/// slice of a solid (discs) may have a plane nu up to 1: say "stress". Throws std::invalid_argument for
/// values without a stable material: E, density <= 0, nu outside (-1, 1), or (-1, 0.5) in plane strain.
PlaneMaterial plane_material(double young_modulus, double poisson_ratio, double density, Plane plane);

}  // namespace ddem::fem
