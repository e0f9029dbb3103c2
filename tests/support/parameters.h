#pragma once
// Contacts and strains that tests of stability share.

#include "dem/core/material.h"
#include "tests/support/assemblies.h"

namespace ddem::test {

inline ContactParameters linear_contact(double lambda) { return {kNormalStiffness, lambda, Kinematics::linear}; }

/// Of discs with k_n/E_p = `softness`, nu_p = 0.3.
inline DeformationParameters strains(Scheme scheme, Correction correction, double softness, int evaluations = 1, double relaxation = 1.0) {
  DeformationParameters d{scheme, correction, kNormalStiffness / softness, 0.3, Plane::stress};
  d.evaluations = evaluations;
  d.relaxation = relaxation;
  return d;
}

}  // namespace ddem::test
