#pragma once
// Exact in time from the states of a leapfrog. With A = M^-1 K, a step dt up to the critical one and
// X = I - dt^2 A/2, the leapfrog started from rest at v passes through T_k(X) v (Chebyshev). A mode of frequency
// omega = (2/dt) sin(psi) has X = cos(2 psi), T_k = cos(2 k psi), and Jacobi and Anger (Abramowitz and Stegun
// 9.1.42, 9.1.43) turn functions of omega t = z sin(psi), z = 2 t/dt, into series of those states,
//     cos(omega t) = J_0(z) + 2 sum_k J_2k(z) T_k:
// what is sought is sum_k a_k(t) T_k(X) v, exact to round-off at any t, for a few states more than t/dt. The other
// cases are integrals of this one over time. Only receivers need them, so the cost is small beside the marching.

#include <cstddef>
#include <span>

namespace ddem {

/// States T_0 v .. T_(count-1) v after which all coefficients up to `time` are below 1e-18 of the largest. `time`
/// >= 0, `time_step` > 0.
std::size_t states_for(double time, double time_step);

// The coefficients of one or more times fill `a`: a_k(t_m) at a[k * times.size() + m], zeros included, for k from 0 to
// a.size()/times.size() - 1, in a time of order z. Eight times take little more than one, and each has the bits that it has
// alone.

/// u(t) = cos(sqrt(A) t) v: released from rest at v.
void release_coefficients(std::span<const double> times, double time_step, std::span<double> a);

/// u(t) = sin(sqrt(A) t)/sqrt(A) v: struck at rest with velocity v. a_k in s.
void impulse_coefficients(std::span<const double> times, double time_step, std::span<double> a);

/// g(t) = sin^2(pi t/duration) for 0 <= t <= duration, 0 after it.
struct Sin2 {
  double duration = 0.0;  ///< s

  double operator()(double time) const;
  double rate(double time) const;  ///< g'(t), 1/s
};

/// Steps up to this one can resolve the pulse; see drive_coefficients.
double largest_step_for(const Sin2& pulse);

/// u(t) = int_0^t sin(sqrt(A) (t - s))/sqrt(A) g(s) ds v: at rest, and accelerated by g(t) v; a_k in s^2. Needs
/// time_step <= largest_step_for(pulse), or throws std::invalid_argument.
void drive_coefficients(const Sin2& pulse, std::span<const double> times, double time_step, std::span<double> a);

}  // namespace ddem
