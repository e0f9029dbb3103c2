#include "dem/spectra/rigid_stiffness.h"

#include <cmath>

#include "dem/assembly/bond_stiffness.h"
#include "dem/spectra/scheme_stiffness.h"

namespace ddem {

RigidStiffness::RigidStiffness(const Assembly& a, const ContactParameters& contact, const HeldDofs& held)
    : bonds_(a.bonds),
      stiffness_(contact.uniform() ? std::vector<double>{contact.normal_stiffness} : normal_stiffnesses(a, contact)),
      stiffness_ratio_(contact.stiffness_ratio),
      rotation_(contact.has_rotation()) {
  const int components = rotation_ ? 3 : 2;
  scaling_.resize(components * static_cast<Eigen::Index>(a.size()));
  moved_.resize(scaling_.size());
  for (std::size_t p = 0; p < a.size(); ++p) {
    double* s = scaling_.data() + components * static_cast<Eigen::Index>(p);
    s[0] = s[1] = std::sqrt(1.0 / a.mass[p]);
    if (rotation_) s[2] = std::sqrt(1.0 / a.inertia[p]);
  }
  hold(held, components, scaling_);
}

void RigidStiffness::apply(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> y) {
  moved_ = scaling_.cwiseProduct(x);
  y.setZero();
  rotation_ ? add_forces<true>(y.data()) : add_forces<false>(y.data());
  y.array() *= scaling_.array();
}

/// C^T K C q, with the rows of a bond as bond_rows() has them (statics/operators.h).
template <bool kRotation>
void RigidStiffness::add_forces(double* y) const {
  constexpr Eigen::Index kComponents = kRotation ? 3 : 2;
  const std::size_t each = stiffness_.size() == 1 ? 0 : 1;
  for (std::size_t c = 0; c < bonds_.size(); ++c) {
    const Eigen::Index i = kComponents * bonds_.i[c], j = kComponents * bonds_.j[c];
    const double *qi = moved_.data() + i, *qj = moved_.data() + j;
    const double nx = bonds_.nx[c], ny = bonds_.ny[c], ux = qj[0] - qi[0], uy = qj[1] - qi[1], k_n = stiffness_[each * c];
    const double f_n = k_n * (nx * ux + ny * uy);
    double fx = f_n * nx, fy = f_n * ny;
    if constexpr (kRotation) {
      const double f_t = stiffness_ratio_ * k_n * (nx * uy - ny * ux - bonds_.arm_i[c] * qi[2] - bonds_.arm_j[c] * qj[2]);
      fx -= f_t * ny, fy += f_t * nx;
      y[i + 2] -= bonds_.arm_i[c] * f_t, y[j + 2] -= bonds_.arm_j[c] * f_t;
    }
    y[i] -= fx, y[i + 1] -= fy;
    y[j] += fx, y[j + 1] += fy;
  }
}

}  // namespace ddem
