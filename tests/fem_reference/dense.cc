#include "tests/fem_reference/dense.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "dem/spectra/dense_eigen.h"

namespace ddem::fem::test {

std::vector<double> Modes::apply(const std::function<double(double)>& f, const std::vector<double>& v) const {
  std::vector<double> result(v.size(), 0.0);
  for (std::size_t m = 0; m < vectors.size(); ++m) {
    double amplitude = 0.0;
    for (std::size_t k = 0; k < free.size(); ++k) amplitude += vectors[m][k] * v[free[k]] / root_inverse_mass[k];
    amplitude *= f(std::sqrt(std::max(0.0, squared_frequencies[m])));
    for (std::size_t k = 0; k < free.size(); ++k) result[free[k]] += amplitude * vectors[m][k] * root_inverse_mass[k];
  }
  return result;
}

Modes modes(const ElasticOperator& stiffness, const std::vector<double>& inverse_mass) {
  Modes result;
  for (std::size_t k = 0; k < inverse_mass.size(); ++k) {
    if (inverse_mass[k] <= 0.0) continue;
    result.free.push_back(k);
    result.root_inverse_mass.push_back(std::sqrt(inverse_mass[k]));
  }
  const auto size = static_cast<Eigen::Index>(result.free.size());
  Eigen::MatrixXd a(size, size);
  std::vector<double> u(stiffness.vector_size(), 0.0), force(u.size());
  for (Eigen::Index column = 0; column < size; ++column) {
    u[result.free[column]] = 1.0;
    stiffness.apply(u, force);
    u[result.free[column]] = 0.0;
    for (Eigen::Index row = 0; row < size; ++row) {
      a(row, column) = result.root_inverse_mass[row] * force[result.free[row]] * result.root_inverse_mass[column];
    }
  }
  const SymmetricPairs pairs = symmetric_pairs(a, "modes");
  for (Eigen::Index m = 0; m < size; ++m) {
    result.squared_frequencies.push_back(pairs.values[m]);
    const auto vector = pairs.vectors.col(m);
    result.vectors.emplace_back(vector.begin(), vector.end());
  }
  return result;
}

std::vector<double> solve_statics(const ElasticOperator& stiffness, const std::vector<double>& force,
                                  const std::vector<bool>& fixed, std::vector<double> u) {
  std::vector<std::size_t> free;
  for (std::size_t k = 0; k < fixed.size(); ++k) {
    if (!fixed[k]) {
      free.push_back(k);
      u[k] = 0.0;
    }
  }
  const auto size = static_cast<Eigen::Index>(free.size());
  std::vector<double> image(u.size()), unit(u.size(), 0.0);
  stiffness.apply(u, image);
  Eigen::VectorXd right(size);
  Eigen::MatrixXd a(size, size);
  for (Eigen::Index k = 0; k < size; ++k) right[k] = force[free[k]] - image[free[k]];
  for (Eigen::Index column = 0; column < size; ++column) {
    unit[free[column]] = 1.0;
    stiffness.apply(unit, image);
    unit[free[column]] = 0.0;
    for (Eigen::Index row = 0; row < size; ++row) a(row, column) = image[free[row]];
  }
  const Eigen::VectorXd solution = a.llt().solve(right);
  for (Eigen::Index k = 0; k < size; ++k) u[free[k]] = solution[k];
  return u;
}

}  // namespace ddem::fem::test
