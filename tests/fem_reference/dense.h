#pragma once
// Small operators as dense matrices, and functions of M^-1 K by its eigenvectors.

#include <functional>
#include <vector>

#include "fem_reference/kernel/elastic_operator.h"

namespace ddem::fem::test {

/// Eigenpairs of M^-1/2 K M^-1/2 on the free degrees of freedom (inverse mass > 0).
struct Modes {
  std::vector<double> squared_frequencies;           ///< ascending
  std::vector<std::vector<double>> vectors;          ///< of the symmetric matrix, free entries only
  std::vector<std::size_t> free;                     ///< degrees of freedom
  std::vector<double> root_inverse_mass;             ///< of the free ones

  /// f(sqrt(M^-1 K)) v, zero where not free.
  std::vector<double> apply(const std::function<double(double)>& f, const std::vector<double>& v) const;
};

Modes modes(const ElasticOperator& stiffness, const std::vector<double>& inverse_mass);

/// u with K u = force where `fixed` is false and u as given elsewhere.
std::vector<double> solve_statics(const ElasticOperator& stiffness, const std::vector<double>& force,
                                  const std::vector<bool>& fixed, std::vector<double> u);

}  // namespace ddem::fem::test
