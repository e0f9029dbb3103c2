#include "tests/fem_reference/strip_modes.h"

#include <Eigen/Core>
#include <cmath>

#include "dem/spectra/dense_eigen.h"
#include "fem_reference/kernel/gauss_lobatto.h"

namespace ddem::fem::test {

namespace {

constexpr int p = 8;

}  // namespace

StripModes::StripModes(const PlaneMaterial& m, double width, double k, int elements)
    : element_width_(0.5 * width / elements) {
  const GaussLobatto rule = gauss_lobatto(p);
  const int nodes = elements * p + 1;
  const double h = element_width_, stiff = m.lame_lambda + 2.0 * m.shear_modulus;
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(2 * nodes, 2 * nodes);  // U, then V
  Eigen::VectorXd mass = Eigen::VectorXd::Zero(2 * nodes);
  for (int e = 0; e < elements; ++e) {
    for (int q = 0; q <= p; ++q) {
      const double weight = h * rule.weights[q];
      const int node = e * p + q;
      Eigen::RowVectorXd u = Eigen::RowVectorXd::Zero(2 * nodes), v = u, u_slope = u, v_slope = u;
      u[node] = v[nodes + node] = 1.0;
      for (int a = 0; a <= p; ++a) {
        u_slope[e * p + a] = rule.derivative[q * (p + 1) + a] / h;
        v_slope[nodes + e * p + a] = rule.derivative[q * (p + 1) + a] / h;
      }
      const Eigen::RowVectorXd slip = u_slope - k * v;
      // Only the element's own rows and columns are not zero; the matrices are small.
      stiffness += weight * (stiff * (k * k * u.transpose() * u + v_slope.transpose() * v_slope) +
                             m.lame_lambda * k * (u.transpose() * v_slope + v_slope.transpose() * u) +
                             m.shear_modulus * slip.transpose() * slip);
      mass[node] += weight * m.density;
      mass[nodes + node] += weight * m.density;
    }
  }
  // V is odd: its node in the middle is taken out.
  const Eigen::Index size = 2 * nodes - 1;
  std::vector<Eigen::Index> kept;
  for (Eigen::Index row = 0; row < 2 * nodes; ++row) {
    if (row != nodes) kept.push_back(row);
  }
  const Eigen::VectorXd root = mass(kept).cwiseSqrt();
  const Eigen::MatrixXd scaled = root.cwiseInverse().asDiagonal() * stiffness(kept, kept) * root.cwiseInverse().asDiagonal();
  const SymmetricPairs pairs = symmetric_pairs(scaled, "strip modes");
  frequency_ = pairs.values.cwiseMax(0.0).cwiseSqrt();
  // The start is U = 1, V = 0; eigenvectors are orthonormal with the mass, hence mean and share are one product.
  Eigen::VectorXd start = Eigen::VectorXd::Zero(size);
  start.head(nodes) = root.head(nodes);
  const Eigen::VectorXd share = pairs.vectors.transpose() * start;
  mean_ = share.cwiseAbs2() / start.squaredNorm();
  shape_ = root.head(nodes).cwiseInverse().asDiagonal() * pairs.vectors.topRows(nodes) * share.asDiagonal();
}

Eigen::VectorXd StripModes::at(double y) const {
  const double place = std::abs(y) / element_width_;
  const auto element = std::min(static_cast<Eigen::Index>(place), (shape_.rows() - 1) / p - 1);
  const std::vector<double> weights = lagrange_values(gauss_lobatto(p).points, place - static_cast<double>(element));
  const Eigen::Map<const Eigen::RowVectorXd> row(weights.data(), p + 1);
  return (row * shape_.middleRows(element * p, p + 1)).transpose();
}

}  // namespace ddem::fem::test
