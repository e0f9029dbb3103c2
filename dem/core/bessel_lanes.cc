// Includes nothing of the library: no inline function of another header is compiled for an instruction set that is not
// everywhere. The lanes do not mix, and nothing is contracted: the same bits for any instruction set and any neighbours.

#include "dem/core/bessel_lanes.h"

namespace ddem::DDEM_ISA {
namespace {

typedef double Vec __attribute__((vector_size(bessel_lanes * sizeof(double))));
typedef double InMemory __attribute__((vector_size(bessel_lanes * sizeof(double)), aligned(sizeof(double)), may_alias));  // wherever it starts

// Miller's recurrence J_(n-1) = (2n/z) J_n - J_(n+1) from each lane's order down to 0: visit(n, c J_n), 1 = J_0 + 2 sum J_2k.
template <typename Visit>
void visit_bessel(const BesselTimes& times, double* scale, const Visit& visit) {
  std::size_t most = 0, least = ~std::size_t{0};
  for (const std::size_t order : times.order) {
    most = order > most ? order : most;
    least = order > 0 && order < least ? order : least;
  }
  const Vec two_over_z = *reinterpret_cast<const InMemory*>(times.two_over_z);
  Vec above{}, here{}, sum{};
  for (std::size_t n = most; n > 0; --n) {
    for (std::size_t l = 0; n >= least && l < bessel_lanes; ++l) {
      if (times.order[l] == n) here[l] = 1e-250;
    }
    visit(n, here);
    if (n % 2 == 0) sum += 2.0 * here;
    const Vec below = static_cast<double>(n) * two_over_z * here - above;
    above = here;
    here = below;
  }
  visit(std::size_t{0}, here);
  *reinterpret_cast<InMemory*>(scale) = sum + here;
}

void store(double* out, std::size_t k, const Vec& value) {
  *reinterpret_cast<InMemory*>(out + k * bessel_lanes) = k == 0 ? value : 2.0 * value;
}

void released(const BesselTimes& times, double* out, double* scale) {
  visit_bessel(times, scale, [&](std::size_t n, const Vec& j) {
    if (n % 2 == 0 && n / 2 < times.count) store(out, n / 2, j);
  });
}

// I_(n-1) = I_(n+1) + 2 J_n; int cos(omega t) dt = (dt/2) (I_0 + 2 sum I_2k T_k).
void struck(const BesselTimes& times, double* out, double* scale) {
  Vec above{}, here{};
  visit_bessel(times, scale, [&](std::size_t n, const Vec& j) {
    if (n % 2 == 0 && n / 2 < times.count) store(out, n / 2, here);
    const Vec below = above + 2.0 * j;
    above = here;
    here = below;
  });
}

// D_(n-1) = D_(n+1) + 2 i alpha D_n + 2 J_n. sin(omega t)/omega = dt sum_k J_(2k+1) W_k, W_k = T_0 + 2 (T_1 + .. + T_k): the
// coefficient of T_j is the sum over k >= j.
void driven(const BesselTimes& times, double* out, double* scale) {
  const double two_alpha = times.two_alpha;
  Vec i_above{}, i_here{}, tail{}, re_above{}, im_above{}, re_here{}, im_here{};
  visit_bessel(times, scale, [&](std::size_t n, const Vec& j) {
    if (n % 2 == 1) {
      tail += i_here - re_here;
      if (n / 2 < times.count) store(out, n / 2, tail);
    }
    const Vec i_below = i_above + 2.0 * j;
    const Vec re_below = re_above - two_alpha * im_here + 2.0 * j, im_below = im_above + two_alpha * re_here;
    i_above = i_here, i_here = i_below;
    re_above = re_here, re_here = re_below;
    im_above = im_here, im_here = im_below;
  });
}

}  // namespace

extern const BesselFill fill_bessel;
const BesselFill fill_bessel = [](BesselSeries series, const BesselTimes& times, double* out, double* scale) {
  switch (series) {
    case BesselSeries::released:
      return released(times, out, scale);
    case BesselSeries::struck:
      return struck(times, out, scale);
    case BesselSeries::driven:
      return driven(times, out, scale);
  }
};

}  // namespace ddem::DDEM_ISA
