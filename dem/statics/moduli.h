#pragma once
// Effective plane moduli from static solves: what the wave speeds of an assembly are compared with.
// Moduli are plane moduli divided by the thickness (Pa for unit thickness).

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "dem/assembly/assembly.h"
#include "dem/core/material.h"
#include "dem/statics/operator_rates.h"
#include "dem/statics/sections.h"

namespace ddem {

/// Rows and columns xx, yy, xy; engineering shear. Symmetric for every correction that derives from an energy.
using PlaneStiffness = Eigen::Matrix3d;

/// Isotropic plane elasticity: E = 4KG/(K+G), nu = (K-G)/(K+G).
struct IsotropicModuli {
  double bulk = 0.0, shear = 0.0;
  double young() const { return 4.0 * bulk * shear / (bulk + shear); }
  double poisson() const { return (bulk - shear) / (bulk + shear); }
};

/// The isotropic part (average over rotations): K = (C11 + C22 + 2 C12)/4, G = (C11 + C22 - 2 C12 + 4 C66)/8,
/// C12 the mean of C12 and C21.
IsotropicModuli isotropic_part(const PlaneStiffness& c);

/// Homogenised stiffness of a cell periodic in x and y (packing.period both set): three strains, volume-averaged
/// stress sigma = 1/(A h) sum_c L n (x) F.
PlaneStiffness homogenise_cell(const Assembly& assembly, const ContactParameters& contact,
                               const DeformationParameters& deformation);

/// A stiffness and its derivatives with respect to parameters of contacts and discs.
struct StiffnessRates {
  PlaneStiffness stiffness;
  std::vector<PlaneStiffness> rates;  ///< one a parameter
};

/// Of a cell, or of a strip periodic in y alone (GrippedStrip::stiffness), whichever the packing's periods ask for, with the
/// derivatives: each takes three more solves by the same factorisation. Throws as they do and as operator_rates().
StiffnessRates homogenise_with_rates(const Assembly& assembly, const ContactParameters& contact,
                                     const DeformationParameters& deformation, double edge_band,
                                     std::span<const Parameter> parameters);

/// The free strip pulled at its ends, measured between two inner sections.
struct StripTension {
  double axial_stiffness = 0.0;      ///< EA: force over strain, N
  double mass_per_length = 0.0;      ///< of the discs that move, kg/m
  std::optional<double> lateral_contraction;  ///< -eps_yy / eps_xx; none where the discs stand in one row
  double bar_velocity() const;       ///< sqrt(EA / mass per length): no area enters
};

/// A strip with both ends in grips (the discs within `edge_band` of the outermost centres), factorised once for all that is
/// asked of it. Between periodic edges the grips hold u_x, u_y and rotation, between free ones u_x alone. The assembly must
/// outlive it. Throws as StaticSolver; std::invalid_argument where the strip is too short for inner sections.
class GrippedStrip {
 public:
  GrippedStrip(const Assembly& assembly, const ContactParameters& contact, const DeformationParameters& deformation,
               double edge_band);

  const Assembly& assembly() const { return assembly_; }
  double edge_band() const { return edge_band_; }
  /// Periodic edges: the grips follow the affine motion, strain and stress are measured between two inner sections.
  /// std::invalid_argument between free ones.
  PlaneStiffness stiffness() const;
  /// Free edges: the grips move apart. std::invalid_argument between periodic ones.
  StripTension tension() const;
  /// The right grip moves: see sections.h. As static_sections() but for what the grips hold, which sections a width from the
  /// ends do not feel.
  StaticSections sections(const std::vector<SectionDiscs>& sections) const;

 private:
  const Assembly& assembly_;
  double edge_band_;
  StaticSolver solver_;
};

/// Of a strip that is asked for nothing else.
PlaneStiffness homogenise_strip(const Assembly& assembly, const ContactParameters& contact,
                                const DeformationParameters& deformation, double edge_band);
StripTension pull_strip(const Assembly& assembly, const ContactParameters& contact,
                        const DeformationParameters& deformation, double edge_band);

/// Speeds of waves along x in a continuum of that stiffness: P from C11, S from C66, bar from 1/S11.
struct DirectionalSpeeds {
  double p = 0.0, s = 0.0, bar = 0.0;
};
DirectionalSpeeds directional_speeds(const PlaneStiffness& c, double moving_density);

}  // namespace ddem
