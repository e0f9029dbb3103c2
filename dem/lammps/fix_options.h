#pragma once
// The words of a fix ddem command (harness/guide/lammps.md).

#include <lammps/pointers.h>

#include <array>
#include <string>
#include <vector>

#include "dem/core/material.h"

namespace ddem::lammps {

struct Drive {
  bool on = false;
  bool along_x = true;
  int group_bit = 0;
  double amplitude = 0.0, duration = 0.0;
};

struct FixOptions {
  std::array<int, 3> held{};  ///< bits of groups whose ux, uy, theta are kept; 0: none
  Drive drive;
  std::array<std::string, 3> initial;  ///< names of atom-style variables: ux, uy, theta; empty: 0
  bool integrate = true;
  DeformationParameters deformation;
  double thickness = 1.0;
  double volume_over_disc = 1.0;
  std::vector<double> weights;  ///< implicit: of the polynomial's passes
};

/// Words from the first keyword on. Errors end LAMMPS, with what to write instead.
FixOptions fix_options(LAMMPS_NS::LAMMPS* lmp, int count, char** words);

}  // namespace ddem::lammps
