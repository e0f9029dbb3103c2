#pragma once
// bond_style ddem: bonds of discs with normal and shear stiffness. Their overlaps come from displacements and rotations since
// the reference, which fix ddem keeps.

#include <lammps/bond.h>

#include <cstdio>
#include <vector>

#include "dem/core/material.h"

namespace ddem::lammps {

class FixDdem;

class BondDdem : public LAMMPS_NS::Bond {
 public:
  explicit BondDdem(LAMMPS_NS::LAMMPS* l);
  ~BondDdem() override;

  void settings(int count, char** words) override;
  void coeff(int count, char** words) override;
  void init_style() override;
  void compute(int eflag, int vflag) override;
  double equilibrium_distance(int type) override;
  double single(int type, double rsq, int i, int j, double& force) override;
  void write_restart(std::FILE* file) override;
  void read_restart(std::FILE* file) override;
  void write_restart_settings(std::FILE* file) override;
  void read_restart_settings(std::FILE* file) override;

  Kinematics kinematics() const { return kinematics_; }
  /// k_n and k_t of a bond between discs of these radii.
  double normal_stiffness(int type, double r_i, double r_j) const;
  double shear_stiffness(int type, double r_i, double r_j) const;
  /// All bonds of all types are equally stiff.
  bool uniform() const;

 private:
  struct Coefficient {
    double normal_stiffness = 0.0;  ///< k_n
    double modulus = 0.0;           ///< where positive: k_n = modulus 2 r_i r_j / (r_i + r_j)
    double ratio = 0.0;             ///< k_t / k_n
  };

  void allocate();

  Kinematics kinematics_ = Kinematics::linear;
  std::vector<Coefficient> of_type_;  // from 1
  FixDdem* fix_ = nullptr;
};

}  // namespace ddem::lammps
