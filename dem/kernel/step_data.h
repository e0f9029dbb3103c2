#pragma once
// What one step of the specialised kernels reads and writes: raw pointers into the simulation's arrays, so that the
// kernels, which are compiled once per instruction set, share no inline code with the rest of the program.

#include <cstdint>

namespace ddem {

/// Doubles a disc in the arrays of what its neighbours read: u_x, u_y, r theta or r eps_xx, r eps_yy, r eps_xy (metres), and
/// one to align them.
constexpr int kQuad = 4;

/// m r^2 / I of a disc: a moment over the radius turns r theta as a force so many times as large moves the centre.
constexpr double kRotationalKick = 2.0;

struct StepData {
  // Bonds, see SlicedBonds.
  const std::int32_t* row_begin;
  const std::int32_t* neighbour;
  const double *nx, *ny, *stretch, *length;
  double normal_stiffness, shear_stiffness;  ///< the same for every bond, or
  const double* bond_stiffness;              ///< k_n of every stored half-bond, and
  double stiffness_ratio;                    ///< k_t / k_n

  // Discs. Velocities (n - 1/2 to n + 1/2; omega: r times the angular one) change by the kick, displacements and
  // rotations (kQuad a disc) by the drift, each in place: a disc may drift once all that read it have been kicked.
  double* motion;
  double *vx, *vy, *omega;
  const double *kick_x, *kick_y, *kick_theta;  ///< dt / mass; 0 where held
  double dt;

  // Particle strains (kQuad a disc): in and out; D r^2 / V_p, which takes sum s n (x) F to r eps.
  const double* strain;
  double* strain_next;
  double compliance_direct, compliance_coupling, compliance_shear;
  double keep_strain, new_strain;  ///< lagged: 1 - relaxation, relaxation
  double* pull;                    ///< a stored half-bond: what its own disc adds to the bond's elongation, m; implicit: rigid
  const std::int32_t* other_end;   ///< of the same bond: half_bond of the other disc

  // Implicit strains (kQuad a disc): f = (V C)^-1 S K C u (polynomial), or the residual (conjugate gradients).
  double* source;
  double of_strain, of_source, of_coupling;  ///< polynomial: the next approximation is of_strain eps + of_source f - of_coupling T eps
  double *press, *press_next;      ///< and by how much its strain shortens the bond: of the strains in and out
  const double *dyad_xx, *dyad_yy, *dyad_xy;  ///< s n (x) n
  double *rigid_fx, *rigid_fy, *rigid_moment;  ///< polynomial: forces of rigid discs, moment over r

  // Conjugate gradients.
  double *direction, *applied;     ///< kQuad a disc; applied: (1 + T) direction
  double *product, *scale;         ///< inner products, a share of each disc
  double elasticity_direct, elasticity_coupling, elasticity_shear;  ///< V_p eps : C_p : eps by components of r eps
  double step_length, direction_weight;

  // Watched runs: the largest speed^2 and r^2 (eps_xx^2 + eps_yy^2 + eps_xy^2) of a disc since a thread's own were set to 0.
  double *fastest, *most_strained;

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
  bool per_bond_stiffness = false;
  bool touching = false;  ///< no bond has arms of its own; with linear kinematics and one stiffness for all bonds
  bool pulls = false;  ///< linear, without rotation, lagged in one evaluation or a polynomial: bonds read what the discs pull
  bool watched = false;  ///< note the fastest and the most strained disc
};

/// Works on the slices [begin, end).
using SliceFunction = void (*)(const StepData&, int begin, int end);

struct StepKernels {
  SliceFunction step = nullptr;      ///< forces and kick; lagged: also the strains of the next evaluation
  SliceFunction drift = nullptr;     ///< displacements, by the velocities
  SliceFunction pull = nullptr;      ///< where bonds read it: from the displacements (lagged: and the strains to come), after every drift
  SliceFunction press = nullptr;     ///< the same from the strains to come, where something else than the kernels changed them
  SliceFunction evaluate = nullptr;  ///< lagged: a further evaluation of the strains, nothing moves
  // Implicit, polynomial.
  SliceFunction source = nullptr;   ///< f from the displacements, and the forces of rigid discs
  SliceFunction first_iterate = nullptr;  ///< a better approximation than f, which is the strain to read; noted where watched
  SliceFunction iterate = nullptr;  ///< a better approximation from the last
  SliceFunction last_iterate = nullptr;  ///< the same, noted where watched
  SliceFunction respond = nullptr;  ///< kick by the forces that the source stage has left, and the strains
  // Implicit, conjugate gradients.
  SliceFunction residual = nullptr;  ///< of the strains at hand; the first direction
  SliceFunction apply = nullptr;     ///< the operator on the direction
  SliceFunction advance = nullptr;   ///< the next strains and residual
  SliceFunction turn = nullptr;      ///< the next direction
};

enum class InstructionSet { baseline, avx2, avx512 };

/// The best that this processor runs and this build holds.
InstructionSet best_instruction_set();
StepKernels step_kernels(const StepFeatures& features, InstructionSet isa);

}  // namespace ddem
