#pragma once
// Leapfrog (velocity Verlet with velocities at half steps) for M u'' = -K u:
//     v_{n+1/2} = v_{n-1/2} - dt M^-1 K u_n,   u_{n+1} = u_n + dt v_{n+1/2}.
// Second order in dt: the speed of a wave of frequency omega errs by -(omega dt)^2/24 relative.
// Its invariant is E = v_{n+1/2}' M v_{n+1/2}/2 + u_n' K u_{n+1}/2.

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "fem_reference/kernel/elastic_operator.h"

namespace ddem::fem {

class Leapfrog {
 public:
  /// At t = 0. Without velocities: at rest.
  struct State {
    std::vector<double> displacement, velocity;
  };

  /// `inverse_mass` is 0 for a degree of freedom that does not follow the equation of motion: fixed, or
  /// prescribed through prescribe(). It and the start have vector_size() entries. Keeps a reference to
  /// `stiffness`. Throws std::invalid_argument for wrong sizes or a step <= 0.
  Leapfrog(const ElasticOperator& stiffness, std::vector<double> inverse_mass, State start, double time_step);

  /// `look`, if there is one, is called by each thread of the team once its part of the displacement is new.
  void step(const std::function<void(int)>& look = {});

  std::size_t steps_done() const { return steps_done_; }
  double time() const { return static_cast<double>(steps_done_) * time_step_; }
  double time_step() const { return time_step_; }
  std::span<const double> displacement() const { return u_; }
  /// At time(), as the displacement: v_n = v_{n-1/2} - dt/2 M^-1 K u_n, second order; 0 for what is prescribed. Takes
  /// the time of a step.
  std::vector<double> velocity() const;
  /// To prescribe a degree of freedom of inverse mass 0 at the new time, after step().
  void prescribe(std::size_t degree_of_freedom, double value) { u_[degree_of_freedom] = value; }

  /// The invariant, J per metre of thickness, between the last two states; needs one step done and
  /// prescribed degrees of freedom at rest.
  double energy() const;

 private:
  const ElasticOperator& stiffness_;
  std::vector<double> inverse_mass_, u_, v_, force_;
  double time_step_;
  std::size_t steps_done_ = 0;
};

}  // namespace ddem::fem
