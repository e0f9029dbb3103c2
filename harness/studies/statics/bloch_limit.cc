#include "harness/studies/statics/bloch_limit.h"

#include <chrono>

namespace ddem::harness {
namespace {

// Two things are wrong with omega/k of a finite k. Dispersion, -A (kr)^2 + B (kr)^4 of it: two wave numbers,
// k and 2k, take the first term out and leave -4 B (kr)^4, whose |B| is 0.03 for rigid discs (the chain's sin
// x over x has 1/120) and grows with their softness, over which strains spread, to 0.6 at k_n/E_p = 10. And
// round-off of omega^2, eps omega_max^2, which is 6 eps/(kr)^2 of it for rigid discs, and 25 times as much
// for soft ones whose shear waves are five times as slow. At kr = 0.005 the first is 7e-11 and 1.5e-9, the
// second 5e-11 and 1e-9.
constexpr double kWaveNumber = 0.005;  // kr

}  // namespace

BlochLimit bloch_limit(const ddem::HexagonalLattice& lattice, const ContactParameters& contact,
                       const DeformationParameters& deformation) {
  const auto start = std::chrono::steady_clock::now();
  const HexagonalBloch waves(lattice, contact, deformation);
  const double k = kWaveNumber / lattice.radius;
  const auto once = waves.frequencies({k, 0.0}), twice = waves.frequencies({2.0 * k, 0.0});
  const auto limit = [&](std::size_t branch) {
    return (4.0 * once[branch].real() / k - twice[branch].real() / (2.0 * k)) / 3.0;
  };
  BlochLimit out{limit(0), limit(1)};
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return out;
}

}  // namespace ddem::harness
