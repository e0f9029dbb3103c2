#pragma once
// Effective moduli of assemblies of bonded discs in closed form: exact for the infinite hexagonal lattice of
// equal touching discs, the kinematic (Voigt) estimate for an isotropic random assembly.
//
// Every disc is strained alike. With A = (sum over bonds of k_n L^2) / area, lambda = k_t/k_n, phi the solid
// fraction and the disc's own plane moduli K_p, G_p (unit thickness):
//   DEM  2K = A/2                              2G = A (1 + lambda)/4
//   DDEM 2K = (A/2)/(1 + A/(2 phi 2K_p))
//     N  (published: normal correction, stress of normal and tangential forces)
//        2G = [A (1 + lambda)/4]/(1 + A/(4 phi 2G_p))
//     F  (full correction, symmetrised stress)
//        2G = [A (1 + lambda)/4]/(1 + A (1 + lambda)/(4 phi 2G_p))
//     NN (normal correction, stress of normal forces only)
//        2G = (A/4)/(1 + A/(4 phi 2G_p)) + A lambda/4
// The DEM form is that of Bathurst and Rothenburg (1988) and Luding (2004). The DDEM forms follow from the
// particle stress sigma_p = (1/V_p) sum_c s_c (x) F_c and its strain under a uniform strain of the assembly:
// on average phi sigma_p is the macroscopic stress, and the particle's strain is subtracted from the
// contacts'. With a thickness h, k_n/h takes the place of k_n.

#include <span>

#include "harness/references/plane_elasticity.h"

namespace ddem::references {

enum class ContactModel { dem, ddem_normal, ddem_full, ddem_normal_only_stress };

/// What the closed forms need to know of the geometry.
struct Fabric {
  double length_squares_per_area = 0.0;  ///< sum over bonds of L^2 / area, dimensionless
  double solid_fraction = 0.0;           ///< area of the discs / area
};

/// Hexagonal lattice of touching discs of diameter d: 3 bonds a disc, area sqrt(3)/2 d^2 a disc, hence 2
/// sqrt(3); solid fraction pi/(2 sqrt(3)).
Fabric hexagonal_fabric();

/// Random assembly: bond lengths and disc radii in m, the area of the cell in m2.
Fabric random_fabric(std::span<const double> bond_lengths, std::span<const double> radii, double area);

struct Contact {
  double normal_stiffness = 0.0;  ///< k_n, N/m
  double stiffness_ratio = 0.0;   ///< lambda = k_t/k_n, >= 0
};

/// The disc's material as plane constants (plane_strain_constants() for plane strain), and its thickness, m.
struct Disc {
  PlaneConstants material;
  double thickness = 1.0;
};

/// Plane moduli in Pa (force per length and thickness). For ContactModel::dem only the thickness of `disc` is
/// used. Throws std::invalid_argument on stiffness, fabric, thickness or material that is not positive and
/// finite.
PlaneModuli effective_moduli(ContactModel model, const Fabric& fabric, const Contact& contact,
                             const Disc& disc);

/// Chain of equal touching discs, lambda = 0: the stiffness of a bond in series with the discs' deformation,
/// k_n/(1 + 4 k_n/(pi E_p h)), E_p of plane stress, nu_p immaterial: sigma_p = (1/(pi r^2)) 2 r F, and each
/// of two discs adds r sigma_p/E_p.
double chain_stiffness(double normal_stiffness, double young_modulus, double thickness);

}  // namespace ddem::references
