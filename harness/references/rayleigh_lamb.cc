// With C(z) = cos(sqrt z), S(z) = sin(sqrt z)/sqrt z (cosh and sinh for z < 0), P = p^2, Q = q^2 and h = 1
// the equation
//   F = (Q - k^2)^2 C(P) S(Q) + 4 k^2 P S(P) C(Q) = 0
// is real and entire in w^2. Bracket, for 0 < nu < 1: on the curves between Q = (pi/2)^2 and pi^2 with P < 0
// both terms are positive (C(P), S(Q) > 0, P C(Q) > 0), and so it is at P = 0, Q < pi^2. For w -> 0, F -> 0
// from below; F stays negative up to the lowest root, which meets Q = (pi/2)^2 only in the Lame mode k = pi/2
// (there F = 0 at both Q = k^2 and C(Q) = 0, and it touches without crossing). Hence one root between a small
// w and min(w(P = 0), w(Q = (3 pi/4)^2)).

#include "harness/references/rayleigh_lamb.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "dem/spectra/dense_eigen.h"

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

/// Gauss and Legendre's rule on 0..1 from its recurrence's eigenvalues (Golub and Welsch 1969). Exact for polynomials of degree
/// 79: products of a mode's cosh(k y) and cos(k y) are integrated to round-off up to kW = 100.
struct GaussLegendre {
  static constexpr int count = 40;
  std::array<double, count> points, weights;

  GaussLegendre() {
    Eigen::VectorXd next(count - 1);
    for (int n = 1; n < count; ++n) next[n - 1] = n / std::sqrt(4.0 * n * n - 1.0);
    const SymmetricPairs modes = tridiagonal_pairs(Eigen::VectorXd::Zero(count), next, "Gauss and Legendre's rule");
    for (int n = 0; n < count; ++n) {
      const double share = modes.vectors(0, n);
      points[static_cast<std::size_t>(n)] = 0.5 * (1.0 + modes.values[n]);
      weights[static_cast<std::size_t>(n)] = share * share;
    }
  }
};

void require_poisson_ratio(double nu) {
  if (!(nu >= 0.0 && nu < 1.0))
    throw std::invalid_argument("the S0 branch is computed for plane Poisson's ratios from 0 to below 1");
}

}  // namespace

LambSpeeds lamb_s0(double wave_number_times_width, double poisson_ratio) {
  if (!(wave_number_times_width >= 1e-9 && wave_number_times_width <= 1e4))
    throw std::invalid_argument("wave number times width must lie in 1e-9..1e4");
  require_poisson_ratio(poisson_ratio);
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

double lamb_s0_share(double wave_number_times_width, double poisson_ratio, double phase_speed) {
  if (!(wave_number_times_width >= 1e-9 && wave_number_times_width <= 100.0))
    throw std::invalid_argument("wave number times width must lie in 1e-9..100");
  require_poisson_ratio(poisson_ratio);
  if (poisson_ratio == 0.0) return 1.0;
  const double k = 0.5 * wave_number_times_width;
  const Medium medium(poisson_ratio);
  const double P = k * k * (phase_speed * phase_speed / medium.p_squared - 1.0);
  const double Q = k * k * (phase_speed * phase_speed / medium.s_squared - 1.0);
  // u_x = i X, u_y = Y, s_xy = i T, s_xx = N (both over the shear modulus), from the potentials a cos(p y) and
  // i (b/q) sin(q y) with the edge y = 1 free of s_xy. Written with C and S, so real also where p or q is imaginary.
  const auto cosine = [](double z) { return z >= 0.0 ? std::cos(std::sqrt(z)) : std::cosh(std::sqrt(-z)); };
  const auto sine = [](double z) {
    const double root = std::sqrt(std::abs(z));
    return root < 1e-8 ? 1.0 : (z >= 0.0 ? std::sin(root) : std::sinh(root)) / root;
  };
  const double a = (k * k - Q) * sine(Q), b = 2.0 * k * P * sine(P);
  double mean_x = 0.0, force = 0.0, work = 0.0;
  static const GaussLegendre rule;
  for (std::size_t n = 0; n < rule.points.size(); ++n) {
    const double y = rule.points[n], weight = rule.weights[n];
    const double cp = cosine(P * y * y), cq = cosine(Q * y * y), sp = y * sine(P * y * y), sq = y * sine(Q * y * y);
    const double X = k * a * cp + b * cq, Y = -a * P * sp + k * b * sq;
    const double T = -2.0 * k * a * P * sp + (k * k - Q) * b * sq;
    const double N = -(a * (k * k + Q - 2.0 * P) * cp + 2.0 * k * b * cq);
    mean_x += weight * X;
    force += weight * N;
    work += weight * (N * X - T * Y);
  }
  return mean_x * force / work;
}

}  // namespace ddem::references
