#pragma once
// What the continuum beside the strip leaves.

#include <optional>
#include <string>

#include "harness/studies/waves/waves_data.h"

namespace ddem::harness {

/// One finite-element run: the continuum with the static moduli of an assembly.
struct FemOutcome {
  StripMaterial key;
  StripWave wave = StripWave::shear;
  bool uniaxial = false;  ///< the same bar with nu = 0, which is not dispersive: checks the program itself
  std::string failure;
  std::optional<double> speed;
  double analytical_speed = 0.0;
  long dofs = 0, steps = 0;
  double solve_seconds = 0.0;
  Recording recording;
};

DDEM_MEMBERS(FemOutcome, key, wave, uniaxial, failure, speed, analytical_speed, dofs, steps, solve_seconds, recording)

}  // namespace ddem::harness
