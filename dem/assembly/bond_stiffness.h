#pragma once
// Normal stiffness bond by bond.

#include <vector>

#include "dem/assembly/assembly.h"
#include "dem/core/material.h"

namespace ddem {

/// k_n of every bond, N/m: normal_stiffness for all, or with a contact modulus E_c
///   k_n = E_c 2 r_i r_j / (r_i + r_j),
/// two springs E_c 2 r_i and E_c 2 r_j in series, each disc's own: the harmonic mean of the radii times E_c, as Yade has
/// it for equal materials.
std::vector<double> normal_stiffnesses(const Assembly& assembly, const ContactParameters& contact);

/// The same for two discs.
double normal_stiffness(const ContactParameters& contact, double r_i, double r_j);

}  // namespace ddem
