#include "harness/run/wave_growth.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "harness/model/assemble.h"
#include "harness/run/scene_moduli.h"

namespace ddem::harness {
namespace {

constexpr double kModulusStep = 1e-3;  // of ln E_p, in central differences

const char* name_of(const Branch& branch) {
  Eigen::Index largest = 0;
  branch.motion.cwiseAbs().maxCoeff(&largest);
  return largest == 0 ? "p" : largest == 1 ? "shear" : "rotation";
}

/// theory section 3: |z| - 1 = -(omega dt)(omega tau)/2, tau = dt b r^(s-1)/(1 - r^s), r = 1 - w - w b.
double lag_growth(const DeformationParameters& d, double omega_dt, double b) {
  if (d.scheme != Scheme::lagged) return 0.0;
  const double r = 1.0 - d.relaxation - d.relaxation * b;
  return -0.5 * omega_dt * omega_dt * b * std::pow(r, d.evaluations - 1) / (1.0 - std::pow(r, d.evaluations));
}

}  // namespace

double WaveGrowth::phase_speed() const { return frequency * wavelength / (2.0 * std::numbers::pi); }

double WaveGrowth::growth_per_period(double time_step) const {
  return std::expm1(std::log1p(growth) * 2.0 * std::numbers::pi / (frequency * time_step));
}

std::vector<WaveGrowth> lattice_waves(const HexagonalBloch& bloch, double dt, const std::vector<double>& wavelengths) {
  std::vector<WaveGrowth> waves;
  for (const double wavelength : wavelengths) {
    const WaveVector k{2.0 * std::numbers::pi / wavelength, 0.0};
    for (const Branch& branch : bloch.branches(k)) {
      const double omega = branch.frequency.real();
      waves.push_back({name_of(branch), wavelength, omega, std::abs(bloch.multiplier_of(k, dt, omega)) - 1.0, true});
    }
  }
  return waves;
}

std::vector<WaveGrowth> static_waves(const Scene& scene, double dt, const std::vector<double>& wavelengths) {
  const auto speeds = [&](double factor) {
    Scene changed = scene;
    if (changed.deformation) changed.deformation->young_modulus *= factor;
    const SceneModuli m = scene_moduli(changed);
    const bool periodic = scene.assembly.periodic.y;
    return std::pair{m.speed_of(Wave::shear, periodic), m.speed_of(Wave::longitudinal, periodic)};
  };
  const DeformationParameters d = deformation_parameters(scene);
  const auto now = speeds(1.0);
  const bool lagged = d.scheme == Scheme::lagged;
  const auto soft = lagged ? speeds(std::exp(-kModulusStep)) : now, stiff = lagged ? speeds(std::exp(kModulusStep)) : now;
  std::vector<WaveGrowth> waves;
  const auto add = [&](const char* name, double wavelength, const auto& speed) {
    if (!(now.*speed)) return;
    const double omega = 2.0 * std::numbers::pi / wavelength * *(now.*speed);
    // C goes with the square of the speed.
    const double share = lagged ? 2.0 * std::log(*(stiff.*speed) / *(soft.*speed)) / (2.0 * kModulusStep) : 0.0;
    waves.push_back({name, wavelength, omega, lag_growth(d, omega * dt, share / (1.0 - share)), false});
  };
  using Speeds = std::remove_cvref_t<decltype(now)>;
  for (const double wavelength : wavelengths) {
    add("shear", wavelength, &Speeds::first);
    add(scene.assembly.periodic.y ? "p" : "bar", wavelength, &Speeds::second);
  }
  return waves;
}

}  // namespace ddem::harness
