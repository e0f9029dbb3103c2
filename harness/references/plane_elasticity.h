#pragma once
// Isotropic elasticity in two dimensions: conversions and wave speeds.

namespace ddem::references {

/// Plane bulk and shear modulus, Pa: sigma_xx + sigma_yy = 2 K (eps_xx + eps_yy), sigma_xy = 2 G eps_xy.
struct PlaneModuli {
  double bulk = 0.0, shear = 0.0;
};

/// Young's modulus and Poisson's ratio of the plane: sigma_xx = E eps_xx, eps_yy = -nu eps_xx under uniaxial
/// plane tension; -1 < nu < 1.
struct PlaneConstants {
  double young_modulus = 0.0, poisson_ratio = 0.0;
};

/// E = 4 K G/(K + G), nu = (K - G)/(K + G).
PlaneConstants plane_constants(const PlaneModuli& moduli);

/// 2K = E/(1 - nu), 2G = E/(1 + nu).
PlaneModuli plane_moduli(const PlaneConstants& constants);

/// Plane strain of a solid with E, nu looks like plane constants E/(1 - nu^2), nu/(1 - nu); -1 < nu < 1/2.
/// In plane stress the plane constants are those of the solid.
PlaneConstants plane_strain_constants(double young_modulus, double poisson_ratio);

struct BulkWaveSpeeds {
  double bar = 0.0;    ///< sqrt(E/rho): a strip with free edges, long waves
  double shear = 0.0;  ///< sqrt(G/rho)
  double p = 0.0;      ///< sqrt((K + G)/rho): no lateral strain
};

/// In m/s, from moduli in Pa and the bulk density in kg/m3.
BulkWaveSpeeds bulk_wave_speeds(const PlaneModuli& moduli, double bulk_density);

// All of the above throw std::invalid_argument on constants that no stable material has, or that are not
// finite.

}  // namespace ddem::references
