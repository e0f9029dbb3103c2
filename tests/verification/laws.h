#pragma once
// Contact laws that the verification loops over, and the closed form of each.

#include <array>
#include <string>

#include "dem/core/material.h"
#include "dem/statics/moduli.h"
#include "harness/references/effective_moduli.h"

namespace ddem::test {

/// Plain DEM, or one of the corrections with particle strain.
struct Law {
  const char* name;
  Scheme scheme;
  Correction correction;
  references::ContactModel closed_form;
};

inline constexpr std::array<Law, 4> kLaws = {
    Law{"DEM", Scheme::none, Correction::normal, references::ContactModel::dem},
    Law{"N", Scheme::lagged, Correction::normal, references::ContactModel::ddem_normal},
    Law{"F", Scheme::lagged, Correction::full, references::ContactModel::ddem_full},
    Law{"NN", Scheme::lagged, Correction::normal_only_stress,
        references::ContactModel::ddem_normal_only_stress}};
inline constexpr const Law& kDem = kLaws[0];
inline constexpr const Law& kFull = kLaws[2];

/// A lattice's parameters: everything that its moduli depend on.
struct LatticeCase {
  Law law;
  double normal_stiffness = 1e10, stiffness_ratio = 0.0;
  double young_modulus = 4e10, poisson_ratio = 0.3;
  Plane plane = Plane::stress;
  double thickness = 1.0;

  ContactParameters contact() const { return {normal_stiffness, stiffness_ratio, Kinematics::linear}; }
  DeformationParameters deformation() const {
    return {law.scheme, law.correction, young_modulus, poisson_ratio, plane};
  }
  std::string description() const {
    return std::string(law.name) + ", k_t/k_n = " + std::to_string(stiffness_ratio) +
           ", k_n/E_p = " + std::to_string(normal_stiffness / young_modulus) +
           ", nu_p = " + std::to_string(poisson_ratio) + (plane == Plane::stress ? ", stress" : ", strain");
  }
};

/// Exact moduli of the infinite hexagonal lattice.
inline IsotropicModuli closed_form(const LatticeCase& c) {
  const references::Disc disc{c.plane == Plane::strain
                                  ? references::plane_strain_constants(c.young_modulus, c.poisson_ratio)
                                  : references::PlaneConstants{c.young_modulus, c.poisson_ratio},
                              c.thickness};
  const references::PlaneModuli m = references::effective_moduli(
      c.law.closed_form, references::hexagonal_fabric(), {c.normal_stiffness, c.stiffness_ratio}, disc);
  return {m.bulk, m.shear};
}

}  // namespace ddem::test
