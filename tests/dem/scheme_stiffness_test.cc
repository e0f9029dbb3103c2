// The stiffness that predictions take for implicit strains is that which a step meets.

#include "dem/spectra/scheme_stiffness.h"

#include <gtest/gtest.h>

#include "dem/simulation/simulation.h"
#include "dem/spectra/strain_polynomial.h"
#include "tests/support/assemblies.h"
#include "tests/support/parameters.h"

namespace ddem {
namespace {

using test::linear_contact;
using test::strains;

/// Accelerations x and y of each disc, displaced by `u`: a leapfrog's first velocity is half a step of them.
Eigen::VectorXd accelerations(const Assembly& a, const ContactParameters& contact, const DeformationParameters& d, const Eigen::VectorXd& u,
                              const std::vector<double>& relaxations = {}) {
  SimulationInput in;
  in.relaxations = relaxations;
  in.contact = contact;
  in.deformation = d;
  in.time_step = 1e-9;
  in.steps = 1;
  for (std::size_t p = 0; p < a.size(); ++p) {
    in.initial.ux.push_back(u[2 * static_cast<Eigen::Index>(p)]);
    in.initial.uy.push_back(u[2 * static_cast<Eigen::Index>(p) + 1]);
  }
  const InitialState after = simulate(a, in).final_state;
  Eigen::VectorXd v(u.size());
  for (std::size_t p = 0; p < a.size(); ++p) {
    v[2 * static_cast<Eigen::Index>(p)] = after.vx[p];
    v[2 * static_cast<Eigen::Index>(p) + 1] = after.vy[p];
  }
  return v * (2.0 / in.time_step);
}

TEST(SchemeStiffness, OfThePolynomialIsThatOfAStep) {
  const Assembly a = test::random_free_strip();
  const std::vector<double> values = test::Noise(5).vector(2 * a.size(), 1e-9);
  const Eigen::VectorXd u = Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  for (const Correction correction : {Correction::normal, Correction::full, Correction::normal_only_stress}) {
    for (const double lambda : {0.0, 0.5}) {
      DeformationParameters d = strains(Scheme::implicit, correction, 1.0);
      d.tolerance = 1e-2;
      const ContactParameters contact = linear_contact(lambda);
      const Operators op = make_operators(a, contact, d);
      Eigen::VectorXd q = Eigen::VectorXd::Zero(op.inverse_mass.size());
      for (Eigen::Index p = 0; p < static_cast<Eigen::Index>(a.size()); ++p) q.segment<2>(op.dofs_per_disc * p) = u.segment<2>(2 * p);
      const auto predicted = [&](const SchemeStiffness& stiffness) {
        const Eigen::VectorXd force = op.inverse_mass.cwiseProduct(stiffness.apply(q));
        Eigen::VectorXd result(u.size());
        for (Eigen::Index p = 0; p < static_cast<Eigen::Index>(a.size()); ++p) result.segment<2>(2 * p) = -force.segment<2>(op.dofs_per_disc * p);
        return result;
      };
      const Eigen::VectorXd measured = accelerations(a, contact, d, u);
      const auto relaxations = strain_relaxations(a, contact, d);
      // Round-off of some hundred operations; converged strains are another stiffness.
      EXPECT_LT((predicted(SchemeStiffness::polynomial(op, relaxations)) - measured).norm(), 1e-12 * measured.norm());
      EXPECT_GT((predicted(SchemeStiffness::converged(op)) - measured).norm(), 1e-5 * measured.norm());
      // Given relaxations are taken: those that would have been found, and others.
      EXPECT_EQ(accelerations(a, contact, d, u, relaxations), measured);
      EXPECT_GT((accelerations(a, contact, d, u, {0.9, 0.9}) - measured).norm(), 1e-5 * measured.norm());
    }
  }
}

}  // namespace
}  // namespace ddem
