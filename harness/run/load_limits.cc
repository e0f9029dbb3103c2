#include "harness/run/load_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "harness/io/errors.h"
#include "harness/run/measurability.h"
#include "harness/scene/place.h"

namespace ddem::harness {
namespace {

// Of a pulse's height, a mean radius of displacement: 0.22 % at a tenth of a radius, in proportion to it (a shear pulse in the
// lattice; a released column and single discs at free edges show several times that).
constexpr double kLinearError = 0.022;
constexpr double kWorthAWarning = 1e-3;
constexpr double kMostGrowth = 2.0;
// Neighbouring discs that a strain moves apart by a radius, or by as much of it as is worth a warning.
constexpr double kMostStrain = 0.5, kSmallStrain = kMostStrain * kWorthAWarning / kLinearError;

double entry(const std::vector<double>& values, std::size_t k) { return values.empty() ? 0.0 : values[k]; }

double largest_between_bonds(const ddem::Assembly& a, const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& turn) {
  double largest = 0.0;
  for (std::size_t b = 0; b < a.bonds.size(); ++b) {
    const std::size_t i = a.bonds.i[b], j = a.bonds.j[b];
    const double apart = std::hypot(entry(x, j) - entry(x, i), entry(y, j) - entry(y, i));
    const double turned = std::max(std::abs(entry(turn, i)) * a.packing.radius[i], std::abs(entry(turn, j)) * a.packing.radius[j]);
    largest = std::max({largest, apart, turned});
  }
  return largest;
}

const char* key_of(const Scene& scene) {
  if (std::holds_alternative<Drive>(scene.load)) return "drive.amplitude";
  if (std::holds_alternative<InitialPulse>(scene.load)) return "initial.amplitude";
  const auto* state = std::get_if<InitialState>(&scene.load);
  return state != nullptr && state->displacement ? "initial.displacement" : "initial.velocity";
}

double asked_displacement(const Scene& scene, const ddem::Assembly& a, const ddem::InitialState& s, double fastest) {
  if (const auto* drive = std::get_if<Drive>(&scene.load)) return std::abs(drive->amplitude);
  if (const auto* pulse = std::get_if<InitialPulse>(&scene.load)) return std::abs(pulse->amplitude);
  return largest_between_bonds(a, s.ux, s.uy, s.theta) + fastest * largest_between_bonds(a, s.vx, s.vy, s.omega);
}

std::optional<std::string> displacement_warning(const Scene& scene, const ddem::Assembly& a, double displacement) {
  if (scene.contact.value().kinematics != Kinematics::linear) return std::nullopt;
  const double radii = displacement / mean_radius(a.packing), error = kLinearError * radii;
  if (radii > 1.0) {
    throw InputError(scene_problem(scene, key_of(scene),
                                   fmt::format("displaces discs by {:.3g} mm, {:.3g} mean radii: linear kinematics (contact.kinematics) holds for small "
                                               "displacements only",
                                               1e3 * displacement, radii),
                                   fmt::format("take at most a mean radius, {:.3g} mm, better a hundredth of it, or kinematics = \"nonlinear\"",
                                               1e3 * mean_radius(a.packing))));
  }
  if (error < kWorthAWarning) return std::nullopt;
  return fmt::format("{}: displacements of {:.2g} mean radii are not small: linear kinematics errs by about {:.1g} % of a wave's height, several times "
                     "that in a released column or at free edges; lower the amplitude, or use kinematics = \"nonlinear\"",
                     key_of(scene), radii, 100.0 * error);
}

}  // namespace

std::vector<std::string> load_warnings(const Scene& scene, const ddem::Assembly& a, const ddem::InitialState& initial, double critical_time_step,
                                       double march_step) {
  std::vector<std::string> warnings;
  // A velocity becomes a displacement in 1/omega_max at least.
  const double displacement = asked_displacement(scene, a, initial, 0.5 * critical_time_step);
  if (auto w = displacement_warning(scene, a, displacement)) warnings.push_back(std::move(*w));
  if (march_step > 0.0) {
    if (auto w = drive_warning(scene, march_step)) warnings.push_back(std::move(*w));
  }
  return warnings;
}

std::optional<std::string> end_warning(const Scene& scene, const ddem::Assembly& a, const ddem::InitialState& end) {
  if (!std::holds_alternative<InitialState>(scene.load)) return std::nullopt;
  return displacement_warning(scene, a, asked_displacement(scene, a, {end.ux, end.uy, end.theta, {}, {}, {}}, 0.0));
}

std::optional<std::string> drive_warning(const Scene& scene, double step) {
  const auto* drive = std::get_if<Drive>(&scene.load);
  if (drive == nullptr) return std::nullopt;
  const double longest = longest_drive_step(drive->duration);
  if (step >= longest) {
    throw InputError(scene_problem(scene, "drive.duration",
                                   fmt::format("takes {:.2g} time steps of {:.3g} us: they do not sample such a motion", drive->duration / step, 1e6 * step),
                                   fmt::format("let it last {:.3g} us or longer, shorten the step to {:.3g} us (time.step), or use integrator = \"exact\"",
                                               1e6 * 8.0 * step, 1e6 * drive->duration / 8.0)));
  }
  const double error = drive_error(drive->duration, step);
  if (error < kWorthAWarning) return std::nullopt;
  return fmt::format("drive.duration: a motion of {:.2g} time steps is hardly sampled: its impulse may be off by {:.1g} %; lower the time step, or use "
                     "integrator = \"exact\"",
                     drive->duration / step, 100.0 * error);
}

std::optional<std::string> strain_warning(const Scene& scene, const WaveContext& c, double column_spacing) {
  // Steepest, a squared sine rises by pi/2 of its height over its half width, a gaussian by 0.61 of it over a standard width.
  double per_height = 1.0 / column_spacing;
  if (c.pulse_half_width > 0.0) {
    const auto* pulse = std::get_if<InitialPulse>(&scene.load);
    const bool gaussian = pulse != nullptr && pulse->shape == PulseShape::gaussian;
    per_height = gaussian ? std::exp(-0.5) / pulse->width : 0.5 * std::numbers::pi / (c.pulse_half_width * c.speed);
  }
  const double strain = std::abs(c.source_amplitude) * per_height;
  if (strain > kMostStrain) {
    throw InputError(scene_problem(scene, key_of(scene), fmt::format("strains the continuum by {:.3g}: linear elasticity holds for small strains only", strain),
                                   fmt::format("take at most {:.3g} mm, better a hundredth of it", 1e3 * kMostStrain / per_height)));
  }
  if (strain < kSmallStrain) return std::nullopt;
  return fmt::format("{}: strains of {:.2g} are not small: linear elasticity leaves out what goes with their square; lower the amplitude", key_of(scene), strain);
}

std::optional<FailedMeasurement> growth_of(const std::vector<EnergySample>& energy, double source_end) {
  const auto total = [](const EnergySample& s) { return s.energies.kinetic + s.energies.contact + s.energies.particle; };
  const auto first = std::find_if(energy.begin(), energy.end(), [&](const EnergySample& s) { return s.time >= source_end; });
  for (auto s = first; s != energy.end(); ++s) {
    if (total(*s) <= kMostGrowth * total(*first)) continue;
    return FailedMeasurement{Failure::growing, fmt::format("the run is unstable: after its source has ended, the energy grows {:.3g} times until {:.3g} us; "
                                                           "lower the time step, or see ddem stability",
                                                           total(*s) / total(*first), 1e6 * s->time)};
  }
  return std::nullopt;
}

}  // namespace ddem::harness
