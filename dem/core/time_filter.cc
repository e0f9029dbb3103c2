// The convolutions of J_n with 1 and with exp(i alpha sigma),
//     I_n(z) = int_0^z J_n(s) ds,   D_n(z) = int_0^z J_n(z - s) exp(i alpha s) ds,
// follow from 2 J_n' = J_(n-1) - J_(n+1), integrated against 1 and exp, for n >= 1:
//     I_(n-1) = I_(n+1) + 2 J_n,   D_(n-1) = D_(n+1) + 2 i alpha D_n + 2 J_n.
// Downwards from orders where all vanish these are stable for alpha < 1: solutions of the homogeneous equation keep
// their size, |-i alpha +- sqrt(1 - alpha^2)| = 1.

#include "dem/core/time_filter.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace ddem {
namespace {

using std::numbers::pi;

constexpr double largest_alpha = 0.5;

// The order beyond which J_n(z) is below 1e-18 of its size at n = z: there J_n/J_(n-1) = exp(-arcosh(n/z)) in the
// leading order of Debye's expansion.
std::size_t last_order(double z) {
  double n = std::floor(z), decay = 1.0;
  while (decay > 1e-18) {
    n += 1.0;
    const double ratio = n / z;
    decay /= ratio + std::sqrt(ratio * ratio - 1.0);
  }
  return static_cast<std::size_t>(n);
}

// Miller's recurrence J_(n-1) = (2n/z) J_n - J_(n+1) from `order` down to 0: visit(n, c J_n), returns 1/c from
// J_0 + 2 sum J_2k = 1.
template <typename Visit>
double visit_bessel(double z, std::size_t order, const Visit& visit) {
  const double two_over_z = 2.0 / z;
  double above = 0.0, here = 1e-250, sum = 0.0;
  for (std::size_t n = order; n > 0; --n) {
    visit(n, here);
    if (n % 2 == 0) sum += 2.0 * here;
    const double below = static_cast<double>(n) * two_over_z * here - above;
    above = here;
    here = below;
  }
  visit(std::size_t{0}, here);
  return 1.0 / (sum + here);
}

void scale(std::span<double> a, double factor) {
  for (double& value : a) value *= factor;
}

// J_n(z) is 1 for n = 0 and 0 for the others to 1e-20 below this, which also keeps the recurrence from overflow.
constexpr double smallest_z = 1e-10;

// Adds factor dt^2/4 int int J of the drive (1 - cos(alpha sigma))/2, sigma = 2 s/dt in 0..z, to `a`.
void add_cosine_drive(double alpha, double z, double factor, std::span<double> a, std::span<double> scratch) {
  if (z < smallest_z) return;
  std::fill(scratch.begin(), scratch.end(), 0.0);
  // Of the orders n + 1 and n. sin(omega t)/omega = dt sum_k J_(2k+1) W_k, W_k = T_0 + 2 (T_1 + .. + T_k): the
  // coefficient of T_j is the sum over k >= j.
  double i_above = 0.0, i_here = 0.0, tail = 0.0;
  std::complex<double> d_above = 0.0, d_here = 0.0;
  const double normalisation = visit_bessel(z, last_order(z), [&](std::size_t n, double j) {
    // Here holds order n.
    if (n % 2 == 1) {
      tail += i_here - d_here.real();
      const std::size_t k = n / 2;
      if (k < scratch.size()) scratch[k] = k == 0 ? tail : 2.0 * tail;
    }
    if (n == 0) return;
    const double i_below = i_above + 2.0 * j;
    const std::complex<double> d_below =
        d_above + std::complex<double>(-2.0 * alpha * d_here.imag(), 2.0 * alpha * d_here.real()) + 2.0 * j;
    i_above = i_here;
    i_here = i_below;
    d_above = d_here;
    d_here = d_below;
  });
  for (std::size_t k = 0; k < a.size(); ++k) a[k] += factor * normalisation * scratch[k];
}

}  // namespace

std::size_t states_for(double time, double time_step) {
  const double z = 2.0 * time / time_step;
  return z < smallest_z ? 1 : last_order(z) / 2 + 1;
}

void release_coefficients(double time, double time_step, std::span<double> a) {
  std::fill(a.begin(), a.end(), 0.0);
  const double z = 2.0 * time / time_step;
  if (z < smallest_z) {
    if (!a.empty()) a[0] = 1.0;
    return;
  }
  scale(a, visit_bessel(z, last_order(z), [&](std::size_t n, double j) {
          if (n % 2 == 0 && n / 2 < a.size()) a[n / 2] = n == 0 ? j : 2.0 * j;
        }));
}

void impulse_coefficients(double time, double time_step, std::span<double> a) {
  std::fill(a.begin(), a.end(), 0.0);
  const double z = 2.0 * time / time_step;
  if (z < smallest_z) {
    if (!a.empty()) a[0] = time;
    return;
  }
  // int cos(omega t) dt = (dt/2) (I_0 + 2 sum I_2k T_k).
  double above = 0.0, here = 0.0;
  const double normalisation = visit_bessel(z, last_order(z), [&](std::size_t n, double j) {
    if (n % 2 == 0 && n / 2 < a.size()) a[n / 2] = n == 0 ? here : 2.0 * here;
    const double below = above + 2.0 * j;
    above = here;
    here = below;
  });
  scale(a, 0.5 * time_step * normalisation);
}

double Sin2::operator()(double time) const {
  if (time <= 0.0 || time >= duration) return 0.0;
  const double sine = std::sin(pi * time / duration);
  return sine * sine;
}

double Sin2::rate(double time) const {
  if (time <= 0.0 || time >= duration) return 0.0;
  return pi / duration * std::sin(2.0 * pi * time / duration);
}

double largest_step_for(const Sin2& pulse) {
  return largest_alpha * pulse.duration / pi;
}

void drive_coefficients(const Sin2& pulse, double time, double time_step, std::span<double> a) {
  if (!(time_step <= largest_step_for(pulse) * (1.0 + 1e-12))) {
    throw std::invalid_argument("the time step does not resolve the pulse");
  }
  std::fill(a.begin(), a.end(), 0.0);
  std::vector<double> scratch(a.size());
  // sin^2 = (1 - cos(2 pi t/duration))/2, and what it would do after one period is taken away again.
  const double alpha = pi * time_step / pulse.duration, factor = 0.5 * time_step * 0.5 * time_step;
  add_cosine_drive(alpha, 2.0 * time / time_step, factor, a, scratch);
  if (time > pulse.duration) {
    add_cosine_drive(alpha, 2.0 * (time - pulse.duration) / time_step, -factor, a, scratch);
  }
}

}  // namespace ddem
