#pragma once
// What a state of motion amounts to: its energies, and the stress of every disc. Computed bond by bond, outside of the
// time loop; linear kinematics.
//
// The quantity that leapfrog conserves exactly lies between two steps,
//   E = v_{n+1/2}' M v_{n+1/2} / 2 + e_{n+1}' F_n / 2,  e the rigid overlaps, F the forces (theory section 3).
// With implicit strains F = K (e - G eps(e)) is linear and symmetric in e, so that half e' F is contact and particle
// energy together. With lagged strains nothing is conserved; there the energy is taken with the strains in use,
//   E = v' M v / 2 + w_n' K w_{n+1} / 2 + sum_p V_p eps : C_p : eps / 2,  w = e - G eps.

#include <vector>

#include "dem/assembly/assembly.h"
#include "dem/core/material.h"
#include "dem/kernel/step_data.h"
#include "dem/simulation/new_contact.h"

namespace ddem {

/// Arrays of kQuad doubles a disc, in the order given by `position`: u_x, u_y, r theta; r eps_xx, r eps_yy, r eps_xy (null
/// for rigid discs). `r`: the disc's radius.
struct MotionView {
  const double* values;
  double ux(int p) const { return values[kQuad * p]; }
  double uy(int p) const { return values[kQuad * p + 1]; }
  double theta(int p, double r) const { return values[kQuad * p + 2] / r; }
};
struct StrainView {
  const double* values;
  double xx(int p, double r) const { return values[kQuad * p] / r; }
  double yy(int p, double r) const { return values[kQuad * p + 1] / r; }
  double xy(int p, double r) const { return values[kQuad * p + 2] / r; }
};
/// Velocities half a step after the displacements (omega: r times the angular one), and dt/m (0 where held).
struct VelocityView {
  const double *vx, *vy, *omega;
  const double *kick_x, *kick_y, *kick_theta;
};

/// J; all but `invariant` at the time of the step.
struct Energies {
  double kinetic = 0.0;
  double contact = 0.0;    ///< of bonds and new contacts: sum (k_n u_n^2 + k_t u_t^2) / 2, overlaps corrected by the strains
  double particle = 0.0;   ///< of the discs: sum V_p eps : C_p : eps / 2
  double invariant = 0.0;  ///< see above
};

/// Components of a symmetric tensor, one value a disc.
struct TensorField {
  std::vector<double> xx, yy, xy;
};

class StateAudit {
 public:
  StateAudit(const Assembly& assembly, const ContactParameters& contact, const DeformationParameters& deformation,
             std::vector<int> position);

  /// What was at work in a step: displacements at t_n and t_{n+1}, velocities at n + 1/2, strains (read only for a
  /// deformable scheme), and the new contacts that were closed.
  struct State {
    MotionView now, next;
    VelocityView velocity;
    StrainView strain;
    const std::vector<NewContact>& closed;
  };
  Energies energies(const State& state) const;

  /// sigma_p = (1/V_p) sum_c s_c (x) F_c, symmetrised, of the forces that the deformation law takes (for NN the normal
  /// ones; for rigid discs all): Pa, in the order of the assembly.
  TensorField stress(const MotionView& now, const StrainView& strain, const std::vector<NewContact>& closed) const;

 private:
  struct Overlaps {
    double normal, tangential;
  };
  double radius(int disc) const { return assembly_.packing.radius[disc]; }
  Overlaps rigid_overlaps(std::size_t bond, const MotionView& u) const;
  Overlaps correction(std::size_t bond, const StrainView& strain) const;
  Overlaps corrected_overlaps(std::size_t bond, const MotionView& u, const StrainView& strain) const;
  Overlaps forces(std::size_t bond, const Overlaps& overlaps) const;
  double strain_energy(const StrainView& strain) const;

  struct Load;  // force and moment of every disc
  void add_force(std::size_t bond, const Overlaps& force, Load& load) const;
  double kinetic_energy(const VelocityView& velocity, const Load* load) const;

  const Assembly& assembly_;
  ContactParameters contact_;
  DeformationParameters deformation_;
  std::vector<int> position_, disc_at_;  // places of discs, discs at places
  std::vector<double> normal_stiffness_, volume_;
};

}  // namespace ddem
