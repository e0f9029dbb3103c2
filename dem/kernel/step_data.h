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

  // Particle strains: in and out; D of the disc's material over its volume.
  const double *exx, *eyy, *exy;
  double *exx_next, *eyy_next, *exy_next;
  const double* inverse_volume;
  double compliance_direct, compliance_coupling, compliance_shear;
  double keep_strain, new_strain;  ///< lagged: 1 - relaxation, relaxation

  // Implicit strains by Chebyshev iteration: D S K C u, the last change, and the weights of this iteration.
  double *source_xx, *source_yy, *source_xy;
  double *change_xx, *change_yy, *change_xy;
  double first_weight;                    ///< of the source, in the first approximation
  double change_weight, residual_weight;  ///< of the last change and the residual, in the next one

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
  bool implicit = false;
};

/// Works on the slices [begin, end).
using SliceFunction = void (*)(const StepData&, int begin, int end);

struct StepKernels {
  SliceFunction step = nullptr;      ///< forces, kick and drift; lagged: also the strains of the next evaluation
  SliceFunction evaluate = nullptr;  ///< lagged: a further evaluation of the strains, nothing moves
  SliceFunction source = nullptr;    ///< implicit: first approximation of the strains from the displacements
  SliceFunction iterate = nullptr;   ///< implicit: a better approximation from the last
};

enum class InstructionSet { baseline, avx2, avx512 };

/// The best that this processor runs and this build holds.
InstructionSet best_instruction_set();
StepKernels step_kernels(const StepFeatures& features, InstructionSet isa);

}  // namespace ddem
