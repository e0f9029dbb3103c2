#include "fem_reference/kernel/leapfrog.h"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace ddem::fem {

Leapfrog::Leapfrog(const ElasticOperator& stiffness, std::vector<double> inverse_mass, State start,
                   double time_step)
    : stiffness_(stiffness),
      inverse_mass_(std::move(inverse_mass)),
      u_(std::move(start.displacement)),
      v_(std::move(start.velocity)),
      force_(stiffness.vector_size(), 0.0),
      time_step_(time_step) {
  const std::size_t size = stiffness.vector_size();
  if (v_.empty()) v_.assign(size, 0.0);
  if (inverse_mass_.size() != size || u_.size() != size || v_.size() != size) {
    throw std::invalid_argument("displacement, velocity and inverse mass must have vector_size() entries");
  }
  if (!(time_step > 0.0) || !std::isfinite(time_step)) {
    throw std::invalid_argument("the time step must be positive");
  }
}

void Leapfrog::step(const std::function<void(int)>& look) {
  // v_{1/2} takes half a step from v_0: the start is second order, and E is that of the later steps.
  const double kick = steps_done_ == 0 ? 0.5 * time_step_ : time_step_;
  Team& team = stiffness_.team();
  team.run([&](int thread) {
    stiffness_.apply_share(u_, force_, thread);
    const auto [first, last] = team.part(u_.size(), thread);
    const double drift = time_step_;
    double *__restrict u = u_.data(), *__restrict v = v_.data();
    const double *__restrict inverse_mass = inverse_mass_.data(), *__restrict f = force_.data();
    for (std::size_t k = first; k < last; ++k) {
      v[k] -= kick * (inverse_mass[k] * f[k]);
      u[k] += drift * v[k];
    }
    if (look) look(thread);
  });
  ++steps_done_;
}

std::vector<double> Leapfrog::velocity() const {
  std::vector<double> velocity = v_;
  if (steps_done_ == 0) return velocity;
  std::vector<double> force(u_.size(), 0.0);
  stiffness_.apply(u_, force);
  for (std::size_t k = 0; k < velocity.size(); ++k) velocity[k] -= 0.5 * time_step_ * (inverse_mass_[k] * force[k]);
  return velocity;
}

double Leapfrog::energy() const {
  // force_ still holds K u_n. Compensated (Neumaier): the drift to be seen is at the level of round-off.
  Processes* processes = stiffness_.processes();
  double sum = 0.0, compensation = 0.0;
  for (std::size_t k = 0; k < u_.size(); ++k) {
    if (processes != nullptr && (k / 2 >= stiffness_.node_count() || processes->owned()[k / 2] == 0.0)) continue;
    const double kinetic = inverse_mass_[k] > 0.0 ? v_[k] * v_[k] / inverse_mass_[k] : 0.0;
    const double term = 0.5 * (kinetic + u_[k] * force_[k]);
    const double next = sum + term;
    compensation += std::abs(sum) >= std::abs(term) ? (sum - next) + term : (term - next) + sum;
    sum = next;
  }
  double energy = sum + compensation;
  if (processes != nullptr) processes->sum({&energy, 1});
  return energy;
}

}  // namespace ddem::fem
