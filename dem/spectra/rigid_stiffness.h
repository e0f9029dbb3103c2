#pragma once
// M^-1/2 C^T K C M^-1/2 of rigid discs (symbols of statics/operators.h), applied bond by bond: the matrix and what it is made
// of take 3.5 kB a disc, which 1e7 discs have not.

#include <Eigen/Core>

#include "dem/assembly/assembly.h"
#include "dem/core/material.h"
#include "dem/statics/held_dofs.h"

namespace ddem {

class RigidStiffness {
 public:
  /// The assembly must outlive this.
  RigidStiffness(const Assembly& assembly, const ContactParameters& contact, const HeldDofs& held);

  /// 2 unknowns a disc, or 3 with rotation.
  Eigen::Index size() const { return scaling_.size(); }
  void apply(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> y);

 private:
  template <bool kRotation>
  void add_forces(double* y) const;

  const Bonds& bonds_;
  Eigen::VectorXd scaling_, moved_;  // M^-1/2, zero where held; of x
  std::vector<double> stiffness_;    // k_n: one, or one a bond
  double stiffness_ratio_ = 0.0;
  bool rotation_ = false;
};

}  // namespace ddem
