#pragma once
// What one step of the specialised kernels reads and writes: raw pointers into the simulation's arrays, so that the
// kernels, which are compiled once per instruction set, share no inline code with the rest of the program.

#include <cstdint>

namespace ddem {

struct StepData {
  // Bonds, see SlicedBonds.
  const std::int32_t* row_begin;
  const std::int32_t* neighbour;
  const double *nx, *ny, *length, *arm_own, *arm_other;
  double normal_stiffness, shear_stiffness;

  // Discs. Displacements are read at step n and written at step n + 1 in the other buffer; velocities (n - 1/2 to
  // n + 1/2) are updated in place, since no other disc reads them.
  const double *ux, *uy, *theta;
  double *ux_next, *uy_next, *theta_next;
  double *vx, *vy, *omega;
  const double *kick_x, *kick_y, *kick_theta;  ///< dt / mass, dt / inertia; 0 where held
  double dt;

  // Lagged deformation: strains of step n - 1 in, of step n out; D of the disc's material over its volume.
  const double *exx, *eyy, *exy;
  double *exx_next, *eyy_next, *exy_next;
  const double* inverse_volume;
  double compliance_direct, compliance_coupling, compliance_shear;

  // Nonlinear kinematics, one value a stored half-bond: relative displacement and weighted rotation of the step before,
  // accumulated slip.
  double *previous_dx, *previous_dy, *previous_rotation, *slip;
};

enum class StrainCoupling { none, normal, full, normal_only_stress };

/// Which specialised kernel: one choice per run.
struct StepFeatures {
  bool rotation = false;
  bool nonlinear = false;
  StrainCoupling strain = StrainCoupling::none;
};

/// Advances the discs of slices [begin, end) by one step.
using StepFunction = void (*)(const StepData&, int begin, int end);

enum class InstructionSet { baseline, avx2, avx512 };

/// The best that this processor runs and this build holds.
InstructionSet best_instruction_set();
StepFunction step_function(const StepFeatures& features, InstructionSet isa);

}  // namespace ddem
