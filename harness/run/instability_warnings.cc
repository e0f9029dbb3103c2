#include "harness/run/instability_warnings.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "dem/spectra/limit_bounds.h"
#include "dem/spectra/spectra.h"
#include "harness/model/assemble.h"
#include "harness/model/memory_need.h"
#include "harness/run/wave_growth.h"

namespace ddem::harness {
namespace {

constexpr double kAccuracy = 0.99;  // of critical steps, above 20000 unknowns

/// "by 2.1e-05 a step, 1.5 times in 20000 steps".
std::string growth_text(double log_a_step, long steps) {
  const double times = std::exp(log_a_step * static_cast<double>(steps));
  return fmt::format("by {:.2g} a step, {} in {} steps", std::expm1(log_a_step), times < 1e6 ? fmt::format("{:.4g} times", times) : "more than a million times", steps);
}

/// Of rigid discs: above the critical step the fastest motion takes the factor z, z + 1/z = (omega dt)^2 - 2, |z| = exp(2 acosh(dt/dt_c)).
std::optional<std::string> rigid_warning(const MarchedScheme& m) {
  const double times = m.time_step / m.dem_critical_time_step;
  if (times <= 1.0) return std::nullopt;
  return fmt::format("the step is {:.6g} times the critical one: the fastest motion of the discs grows {}, whether or not the signals show it; lower it", times,
                     growth_text(2.0 * std::acosh(times), m.steps));
}

std::optional<std::string> even_warning(const DeformationParameters& d) {
  if (d.scheme != Scheme::lagged || d.evaluations % 2 != 0 || d.relaxation != 1.0) return std::nullopt;
  return fmt::format("deformation.evaluations = {}: an even number of evaluations without relaxation adds energy to the waves; use an odd number, or "
                     "relaxation below 1",
                     d.evaluations);
}

/// A share w of the new strain stretches the limit of the fixed point to 2/w - 1.
double radius_over_limit(const ddem::Assembly& a, const ContactParameters& contact, const DeformationParameters& d) {
  return fixed_point_radius(a, contact, d) / (2.0 / d.relaxation - 1.0);
}

/// Of the scheme's fast motions; none where its iteration does not tell. Implicit strains soften the discs: what is safe for
/// rigid ones is safe. Slow growth of the published correction with shear stiffness is not in it.
std::optional<double> largest_step(const ddem::Assembly& a, const ContactParameters& contact, DeformationParameters d, const HeldDofs& held, const MarchedScheme& m) {
  if (d.scheme == Scheme::implicit && m.time_step <= m.dem_critical_time_step) return std::nullopt;
  if (contact.stiffness_ratio == 0.0) d.correction = Correction::normal_only_stress;  // the same, and symmetric
  try {
    return d.scheme == Scheme::lagged && d.evaluations % 2 != 0 ? flip_limit_step(a, contact, d, held) : critical_step(a, contact, d, held).step;
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

std::optional<std::string> step_warning(const DeformationParameters& d, std::optional<double> limit, const MarchedScheme& m) {
  if (!limit || m.time_step <= *limit) return std::nullopt;
  return fmt::format("the {} scheme is unstable at this step: its limit is {:.4g} s, {:.3g} of the critical step of DEM; lower step_fraction below that",
                     d.scheme == Scheme::lagged ? "lagged" : "implicit", *limit, *limit / m.dem_critical_time_step);
}

/// N with shear stiffness derives from no energy: its waves may grow at any step, and slowly.
std::optional<std::string> wave_warning(const Scene& scene, const ddem::Assembly& a, const ContactParameters& contact, const DeformationParameters& d,
                                        const MarchedScheme& m) {
  if (d.correction != Correction::normal || contact.stiffness_ratio == 0.0) return std::nullopt;
  if (!std::holds_alternative<HexagonalPacking>(scene.assembly.packing)) return std::nullopt;
  const WorstWave worst = bloch_of(scene, a, contact, d).worst_wave(m.time_step);
  if (worst.growth <= kNoGrowth) return std::nullopt;
  return fmt::format("a plane wave of the lattice grows {}: the normal correction with shear stiffness has no energy; use correction = \"full\", or see "
                     "ddem stability",
                     growth_text(std::log1p(worst.growth), m.steps));
}

}  // namespace

std::vector<std::string> instability_warnings(const Scene& scene, const ddem::Assembly& a, const HeldDofs& held, const MarchedScheme& march) {
  const ContactParameters contact = contact_parameters(scene);
  const DeformationParameters d = deformation_parameters(scene);
  std::vector<std::string> warnings;
  const auto add = [&](std::optional<std::string> warning) {
    if (warning) warnings.push_back(std::move(*warning));
  };
  if (!d.active()) {
    add(rigid_warning(march));
    return warnings;
  }
  add(even_warning(d));
  // Finding the limits themselves takes minutes, and 9 GB, for 1e6 discs.
  const bool safe = d.scheme == Scheme::lagged && march.time_step < kAccuracy * flip_limit_bound(a, contact, d, march.dem_critical_time_step);
  if (d.scheme == Scheme::lagged && !safe) {
    const MemoryPart limits = memory_of_discs(scene, static_cast<double>(a.size()), DiscWork::limits);
    require_memory(scene, {&limits, 1});
    if (const double radius = radius_over_limit(a, contact, d); radius >= 1.0) {
      warnings.push_back(fmt::format("the lagged scheme is unstable here: the spectral radius of K B is {:.4g} times what it may be; stiffen the discs "
                                     "(young_modulus) by that factor, or use scheme = \"implicit\"",
                                     radius));
      return warnings;
    }
  }
  if (!safe) add(step_warning(d, largest_step(a, contact, d, held, march), march));
  add(wave_warning(scene, a, contact, d, march));
  return warnings;
}

}  // namespace ddem::harness
