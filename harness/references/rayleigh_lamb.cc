// With C(z) = cos(sqrt z), S(z) = sin(sqrt z)/sqrt z (cosh and sinh for z < 0), P = p^2, Q = q^2 and h = 1
// the equation
//   F = (Q - k^2)^2 C(P) S(Q) + 4 k^2 P S(P) C(Q) = 0
// is real and entire in w^2. Bracket, for 0 < nu < 1: on the curves between Q = (pi/2)^2 and pi^2 with P < 0
// both terms are positive (C(P), S(Q) > 0, P C(Q) > 0), and so it is at P = 0, Q < pi^2. For w -> 0, F -> 0
// from below; F stays negative up to the lowest root, which meets Q = (pi/2)^2 only in the Lame mode k = pi/2
// (there F = 0 at both Q = k^2 and C(Q) = 0, and it touches without crossing). Hence one root between a small
// w and min(w(P = 0), w(Q = (3 pi/4)^2)).

#include "harness/references/rayleigh_lamb.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace ddem::references {
namespace {

/// C, S and their derivatives by z, all times exp(-sqrt(-z)) for z < 0 so that they never overflow; a common
/// positive factor moves no root and cancels in the group speed.
struct EntireCosine {
  double C, S, dC, dS;
};

EntireCosine entire_cosine(double z) {
  const double root = std::sqrt(std::abs(z));
  double C, S;
  if (z >= 0.0) {
    C = std::cos(root);
    S = root < 1e-8 ? 1.0 : std::sin(root) / root;
  } else {
    C = 0.5 * (1.0 + std::exp(-2.0 * root));
    S = root < 1e-8 ? 1.0 : -0.5 * std::expm1(-2.0 * root) / root;
  }
  // dS/dz = (C - S)/(2z) loses digits near 0: its series, (-1)^n n z^(n-1)/(2n+1)!, is exact to 1e-17 below
  // 0.1.
  double dS;
  if (std::abs(z) >= 0.1) {
    dS = 0.5 * (C - S) / z;
  } else {
    const double scale = z < 0.0 ? std::exp(-root) : 1.0;
    dS = scale * (-1.0 / 6.0 +
                  z * (1.0 / 60.0 + z * (-1.0 / 1680.0 +
                                         z * (1.0 / 90720.0 + z * (-1.0 / 7983360.0 + z / 1037836800.0)))));
  }
  return {C, S, -0.5 * S, dS};
}

/// Half width and density 1, E = 1: squares of the bulk speeds.
struct Medium {
  double p_squared, s_squared;

  explicit Medium(double nu) : p_squared(1.0 / (1.0 - nu * nu)), s_squared(0.5 / (1.0 + nu)) {}
};

double lamb_function(const Medium& medium, double k, double c) {
  const double P = k * k * (c * c / medium.p_squared - 1.0);
  const double Q = k * k * (c * c / medium.s_squared - 1.0);
  const EntireCosine p = entire_cosine(P), q = entire_cosine(Q);
  const double d = Q / (k * k) - 1.0;
  return d * d * p.C * q.S + 4.0 * P / (k * k) * p.S * q.C;  // F / k^4
}

/// -(dF/dk)/(dF/dw) at a root.
double group_speed(const Medium& medium, double k, double c) {
  const double w = k * c, k2 = k * k;
  const double P = w * w / medium.p_squared - k2;
  const double Q = w * w / medium.s_squared - k2;
  const EntireCosine p = entire_cosine(P), q = entire_cosine(Q);
  const double d = Q - k2;
  const double dF_dP = d * d * p.dC * q.S + 4.0 * k2 * (p.S + P * p.dS) * q.C;
  const double dF_dQ = 2.0 * d * p.C * q.S + d * d * p.C * q.dS + 4.0 * k2 * P * p.S * q.dC;
  const double dF_dk2 = -2.0 * d * p.C * q.S + 4.0 * P * p.S * q.C;  // P and Q held
  const double by_k = 2.0 * k * (dF_dk2 - dF_dP - dF_dQ);
  const double by_w = 2.0 * w * (dF_dP / medium.p_squared + dF_dQ / medium.s_squared);
  return -by_k / by_w;
}

}  // namespace

LambSpeeds lamb_s0(double wave_number_times_width, double poisson_ratio) {
  if (!(wave_number_times_width >= 1e-9 && wave_number_times_width <= 1e4))
    throw std::invalid_argument("wave number times width must lie in 1e-9..1e4");
  if (!(poisson_ratio >= 0.0 && poisson_ratio < 1.0))
    throw std::invalid_argument("the S0 branch is computed for plane Poisson's ratios from 0 to below 1");
  if (poisson_ratio == 0.0) return {1.0, 1.0};

  const double k = 0.5 * wave_number_times_width;
  const Medium medium(poisson_ratio);
  constexpr double q_upper = 0.75 * std::numbers::pi;
  double below = 0.5 * std::sqrt(medium.s_squared);
  double above = std::min(std::sqrt(medium.p_squared),
                          std::sqrt(medium.s_squared * (1.0 + q_upper * q_upper / (k * k))));
  for (;;) {
    const double middle = 0.5 * (below + above);
    if (middle <= below || middle >= above) break;
    (lamb_function(medium, k, middle) < 0.0 ? below : above) = middle;
  }
  const double phase = 0.5 * (below + above);
  return {phase, group_speed(medium, k, phase)};
}

}  // namespace ddem::references
