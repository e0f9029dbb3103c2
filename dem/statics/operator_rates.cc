#include "dem/statics/operator_rates.h"

#include <Eigen/Core>
#include <stdexcept>
#include <vector>

#include "dem/assembly/particle_volume.h"

namespace ddem {
namespace {

/// d(C_p)/d(nu_p): entries (xx, xx), (xx, yy) and (xy, xy).
Eigen::Vector3d material_rate(const DeformationParameters& d) {
  double e = d.young_modulus, n = d.poisson_ratio, e_rate = 0.0, n_rate = 1.0;
  if (d.plane == Plane::strain) {
    const double nu = d.poisson_ratio, one = 1.0 - nu * nu;
    e = d.young_modulus / one;
    n = nu / (1.0 - nu);
    e_rate = 2.0 * nu * d.young_modulus / (one * one);
    n_rate = 1.0 / ((1.0 - nu) * (1.0 - nu));
  }
  const double one = 1.0 - n * n;
  const Eigen::Vector3d by_e(1.0 / one, n / one, 2.0 / (1.0 + n));
  const Eigen::Vector3d by_n(2.0 * e * n / (one * one), e * (1.0 + n * n) / (one * one),
                             -2.0 * e / ((1.0 + n) * (1.0 + n)));
  return by_e * e_rate + by_n * n_rate;
}

SparseMatrix poisson_rate(const Assembly& a, const Operators& op, const DeformationParameters& d) {
  const Eigen::Vector3d c = material_rate(d);
  const std::vector<double> volume = particle_volumes(a, d);
  std::vector<Eigen::Triplet<double>> t;
  for (int p = 0; p < static_cast<int>(a.size()); ++p) {
    const double v = volume[p] / (op.length_scale * op.length_scale);
    t.insert(t.end(), {{3 * p, 3 * p, v * c[0]},
                       {3 * p, 3 * p + 1, v * c[1]},
                       {3 * p + 1, 3 * p, v * c[1]},
                       {3 * p + 1, 3 * p + 1, v * c[0]},
                       {3 * p + 2, 3 * p + 2, v * c[2]}});
  }
  SparseMatrix rate(op.strain_stiffness.rows(), op.strain_stiffness.cols());
  rate.setFromTriplets(t.begin(), t.end());
  return rate;
}

}  // namespace

OperatorRates operator_rates(const Assembly& a, const Operators& op, const ContactParameters& contact,
                             const DeformationParameters& deformation, Parameter parameter) {
  OperatorRates rates;
  rates.stiffness = Eigen::VectorXd::Zero(op.stiffness.size());
  if (op.deformable())
    rates.strain_stiffness = SparseMatrix(op.strain_stiffness.rows(), op.strain_stiffness.cols());
  if (parameter == Parameter::stiffness_ratio) {
    if (op.rows_per_bond != 2)
      throw std::invalid_argument(
          "moduli have no derivative with respect to k_t/k_n at 0, where rotations drop out");
    for (Eigen::Index r = 1; r < op.stiffness.size(); r += 2)
      rates.stiffness[r] = op.stiffness[r] / contact.stiffness_ratio;
    return rates;
  }
  if (!op.deformable()) throw std::invalid_argument("rigid discs have no softness and no Poisson's ratio");
  if (parameter == Parameter::log_softness) {
    rates.strain_stiffness = -op.strain_stiffness;
  } else {
    rates.strain_stiffness = poisson_rate(a, op, deformation);
  }
  return rates;
}

}  // namespace ddem
