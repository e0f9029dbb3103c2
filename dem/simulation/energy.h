#pragma once
// Energy of a linear simulation between two steps: the quantity that leapfrog conserves exactly,
//   E = v_{n+1/2}' M v_{n+1/2} / 2 + e_{n+1}' F_n / 2,  e the rigid overlaps, F the forces (theory section 3).
// With implicit strains F = K (e - G eps(e)) is linear and symmetric in e, so that half e' F is contact and particle
// energy together. With lagged strains nothing is conserved; there the energy is taken with the strains in use,
//   E = v' M v / 2 + w_n' K w_{n+1} / 2 + sum_p V_p eps : C_p : eps / 2,  w = e - G eps.

#include <optional>

#include "dem/assembly/assembly.h"
#include "dem/core/material.h"

namespace ddem {

/// Pointers into arrays in the order of the discs given by `position`; theta and strains may be null.
struct MotionView {
  const double *ux, *uy, *theta;
};
struct StrainView {
  const double *exx, *eyy, *exy;
};
struct VelocityView {
  const double *vx, *vy, *omega;
};

class EnergyAudit {
 public:
  EnergyAudit(const Assembly& assembly, const ContactParameters& contact, const DeformationParameters& deformation,
              std::vector<int> position);

  /// J. `strain` is read only for a deformable scheme.
  double energy(const MotionView& now, const MotionView& next, const VelocityView& velocity,
                const StrainView& strain) const;

 private:
  struct Overlaps {
    double normal, tangential;
  };
  Overlaps rigid_overlaps(std::size_t bond, const MotionView& u) const;
  Overlaps correction(std::size_t bond, const StrainView& strain) const;
  double strain_energy(const StrainView& strain) const;

  const Assembly& assembly_;
  ContactParameters contact_;
  DeformationParameters deformation_;
  std::vector<int> position_;
};

}  // namespace ddem
