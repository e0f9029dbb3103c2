#pragma once
// What a long wave along x should take between two cross-sections of a strip, from statics alone: a force F through the
// strip, the same at every x in equilibrium, displaces the sections, and the difference of two of them is the compliance
// of what lies between.
//
// As a line along x the strip obeys F' = m u_tt, u' = s F, with mass and compliance per length m(x), s(x) that vary from
// place to place. To first order in that variation the time from a to b is (1/c_0) int_a^b (1 + dm/2m + ds/2s) dx, what
// is thrown back from behind b aside; up to second order it is sqrt(M S), M the mass and S the compliance between a and
// b: the homogenised speed 1/c^2 = <m> <s> of that very piece. So the mass is the local one, like the compliance: on
// packings of 682 discs it brings each seed closer to its measured speed than the mean mass of the whole strip does
// (scatter of P, k_t = 0: 0.37 against 0.41 %).
//
// Between periodic edges u and F have two components that anisotropy couples: S = [s_xx s_xy; s_yx s_yy] and
// 1/c^2 = <m> times an eigenvalue of S, the smaller one of the wave called P, the larger one of that called S.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "dem/assembly/assembly.h"
#include "dem/core/material.h"
#include "dem/statics/static_solver.h"

namespace ddem {

/// The discs whose mean displacement is a section's, as a receiver takes it.
using SectionDiscs = std::vector<int>;

/// Static displacement of the sections, m/N.
struct StaticSections {
  bool periodic = false;                       ///< in y: P and S; otherwise the bar alone
  std::vector<double> x;                       ///< mean place of each section's discs, m
  std::vector<Eigen::Matrix2d> displacement;   ///< columns: unit F_x, unit F_y (zero where not periodic); rows u_x, u_y
  std::vector<double> mass_before;             ///< of the discs that move, left of the section's x, kg

  /// Speeds of long waves between two sections, m/s; p and s of a periodic strip, bar of a free one, the others 0.
  struct Speeds {
    double p = 0.0, s = 0.0, bar = 0.0;
  };
  /// Throws std::invalid_argument where the second section does not lie behind the first, std::runtime_error where their
  /// compliance is not positive (sections within the boundary layer of an end).
  Speeds between(int from, int to) const;
};

/// Converged particle strains, any correction. The discs of the left end's band (`edge_band` from the outermost centre, m)
/// stay where they are and those of the right one move, all alike: along x, and between periodic edges along y as well.
/// What else they can do they do freely, as under a driven edge; so no other force passes through the strip.
/// Throws std::invalid_argument on an empty section or a disc that does not exist, std::runtime_error without equilibrium.
StaticSections static_sections(const Assembly& assembly, const ContactParameters& contact,
                               const DeformationParameters& deformation, double edge_band,
                               const std::vector<SectionDiscs>& sections);

/// u of each section along x (component 0) or y (1) under a unit force along it, m/N: S(component, component) of the above,
/// of one load alone. Throws as static_sections().
std::vector<double> static_compliances(const Assembly& assembly, const ContactParameters& contact,
                                       const DeformationParameters& deformation, double edge_band,
                                       const std::vector<SectionDiscs>& sections, int component);

/// static_sections() of states that the caller has found: one where only the force along x counts, or two that F and the sections'
/// displacements are made of, u = S F, whatever forces along x and y go with each. Sections as static_sections().
StaticSections sections_under(const Assembly& assembly, const OperatorFrame& operators, std::span<const StaticState> loads,
                              const std::vector<SectionDiscs>& sections);

/// q as in Operators: the discs of the right end's band moved by 1 along x (component 0) or y (1), the others 0.
Eigen::VectorXd right_end_moved(const Assembly& assembly, double edge_band, int component, int dofs_per_disc);

}  // namespace ddem
