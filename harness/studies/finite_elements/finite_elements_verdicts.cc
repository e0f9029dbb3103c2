#include "harness/studies/finite_elements/finite_elements_verdicts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/studies/strip/criteria.h"

namespace ddem::harness {

using reports::Verdict;

Verdict fem_verdict(const StripResults& r, const FemOutcome& f) {
  const std::string kind = fmt::format("fem/{}{}", name(f.wave) == "P" ? "p" : name(f.wave), f.uniaxial ? "-uniaxial" : "");
  Verdict v{.case_id = case_id(kind, f.key), .title = title_of(f.key, fmt::format("Continuum, {} wave", name(f.wave))), .reason = r.fem_failure.empty() ? f.failure : r.fem_failure};
  const bool dispersive = f.wave == StripWave::bar && !f.uniaxial;
  v.criteria = {judge(fmt::format("{} velocity", name(f.wave)), f.speed,
                      dispersive ? relative(f.analytical_speed, 0.04, 0.01) : relative(f.analytical_speed, 1e-4, 1e-4), "m/s",
                      dispersive ? "sqrt(E/rho); S0 dispersion makes an 8 mm pulse in a 2 mm strip up to 2 % slow, growing with nu squared; twice that is allowed"
                                 : "plane waves keep their shape: sqrt(G/rho), sqrt(E/(rho (1 - nu^2))) or, with nu = 0, sqrt(E/rho)")};
  conclude(v);
  return v;
}

std::string continuum_finding(const StripResults& r) {
  double worst = 0.0;
  int measured = 0;
  for (const FemOutcome& f : r.fem) {
    if (f.wave == StripWave::bar || !f.speed) continue;
    ++measured;
    worst = std::max(worst, std::abs(*f.speed / f.analytical_speed - 1.0));
  }
  if (measured == 0) return "";
  return fmt::format("Finite elements with the static moduli of the packings meet the continuum's P and shear speeds within {:.2g} % (runs: {}).", 100.0 * worst, measured);
}

}  // namespace ddem::harness
