#include "harness/run/pulse_dispersion.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "dem/assembly/bond_stiffness.h"
#include "harness/model/assemble.h"
#include "harness/model/load.h"

namespace ddem::harness {
namespace {

constexpr double kWideSpread = 3.5e-3, kSmall = 1e-3;
// Beyond it the next order, a tenth of the square, is worth a word of its own.
constexpr double kMostOfTheSeries = 0.1;

/// How a pulse so much longer is written in the scene; never rounded down.
std::string longer_pulse(const Scene& scene, double times) {
  if (const auto* drive = std::get_if<Drive>(&scene.load)) return fmt::format("a drive.duration of {:.3g} us", 1.01e6 * times * drive->duration);
  return fmt::format("an initial.width of {:.3g} mm", 1.01e3 * times * std::get<InitialPulse>(scene.load).width);
}

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

/// The rotation of discs in a long shear wave, over its shear du_y/dx: where their slips make no moment. One half of an isotropic
/// assembly.
double share_of_turn(const ddem::Assembly& a, const std::vector<double>& stiffness) {
  double moment = 0.0, resistance = 0.0;
  for (std::size_t b = 0; b < a.bonds.size(); ++b) {
    const double w = stiffness[b] * a.bonds.length[b] * a.bonds.length[b];
    moment += w * a.bonds.nx[b] * a.bonds.nx[b], resistance += w;
  }
  return moment / resistance;
}

}  // namespace

double dispersion_area(const ddem::Assembly& a, const ContactParameters& contact, Wave wave) {
  const std::vector<double> k_n = normal_stiffnesses(a, contact);
  const bool shear = wave == Wave::shear, rolls = shear && contact.has_rotation();
  const double beta = rolls ? share_of_turn(a, k_n) : 0.0;
  double second = 0.0, fourth = 0.0;
  for (std::size_t b = 0; b < a.bonds.size(); ++b) {
    const double nx = a.bonds.nx[b], ny = a.bonds.ny[b], k_t = contact.stiffness_ratio * k_n[b];  // t = (-ny, nx)
    const double length = a.bonds.length[b], dx2 = length * length * nx * nx;
    const double w = shear ? k_n[b] * ny * ny : k_n[b] * nx * nx + k_t * ny * ny;
    second += w * dx2, fourth += w * dx2 * dx2 / 12.0;
    if (!rolls) continue;
    const double slip = length * (nx * nx - beta), bend = length * dx2 * (beta / 8.0 - nx * nx / 24.0);
    second += k_t * slip * slip, fourth -= 2.0 * k_t * slip * bend;
  }
  const double turning = rolls ? beta * beta * sum(a.inertia) / sum(a.mass) : 0.0;
  return second > 0.0 ? 0.5 * (fourth / second + turning) : 0.0;
}

std::optional<double> pulse_frequency(const Scene& scene, const WaveContext& c) {
  if (!(c.pulse_half_width > 0.0)) return std::nullopt;
  const auto* pulse = std::get_if<InitialPulse>(&scene.load);
  if (pulse != nullptr && pulse->shape == PulseShape::gaussian) return std::sqrt(3.0) * c.speed / pulse->width;
  return std::numbers::pi / c.pulse_half_width;
}

std::optional<PulseDispersion> pulse_dispersion(const Scene& scene, const ddem::Assembly& a, const WaveContext& c) {
  const auto wave = wave_of(scene);
  const auto omega = pulse_frequency(scene, c);
  if (!wave || !omega) return std::nullopt;
  const double k = *omega / c.speed, turned = *omega * c.march_step;
  return PulseDispersion{-k * k * dispersion_area(a, contact_parameters(scene), *wave), turned * turned / 24.0};
}

std::optional<std::string> dispersion_warning(const Scene& scene, const ddem::Assembly& a, const WaveContext& c) {
  const auto found = pulse_dispersion(scene, a, c);
  if (!found || std::abs(found->total()) <= kWideSpread) return std::nullopt;
  const double share = std::abs(found->total());
  const bool slow = found->total() < 0.0;
  const std::string amount = share > kMostOfTheSeries ? fmt::format("{:g} % or more", 100.0 * kMostOfTheSeries) : fmt::format("about {:.2g} %", 100.0 * share);
  // Both parts go with the square of the frequency.
  return fmt::format("{}: the pulse is short for {}: dispersion makes its top {} {} than the static speed; {} makes that less than {:g} %",
                     std::holds_alternative<Drive>(scene.load) ? "drive.duration" : "initial.width", slow ? "discs of this size" : "this time step", amount,
                     slow ? "slower" : "faster", longer_pulse(scene, std::sqrt(share / kSmall)), 100.0 * kSmall);
}

}  // namespace ddem::harness
