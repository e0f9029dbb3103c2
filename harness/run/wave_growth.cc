#include "harness/run/wave_growth.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "dem/assembly/bond_stiffness.h"
#include "dem/spectra/lag_damping.h"
#include "dem/spectra/spectra.h"
#include "harness/io/errors.h"
#include "harness/model/assemble.h"
#include "harness/run/scene_moduli.h"

namespace ddem::harness {
namespace {

const char* name_of(const Branch& branch) {
  Eigen::Index largest = 0;
  branch.motion.cwiseAbs().maxCoeff(&largest);
  return largest == 0 ? "p" : largest == 1 ? "shear" : "rotation";
}

constexpr MacroStrain kStretch{1.0, 0.0, 0.0}, kShear{0.0, 0.0, 1.0};

/// Discs at both ends of a strip, which statics hold.
HeldDofs held_ends(const ddem::Assembly& a, double edge_band, bool y_and_theta) {
  HeldDofs held;
  if (a.packing.period.x > 0.0) return held;
  held.x.assign(a.size(), 0);
  for (const ddem::Edge e : {ddem::Edge::left, ddem::Edge::right}) {
    for (const int d : edge_discs(a, e, edge_band)) held.x[d] = 1;
  }
  if (y_and_theta) held.y = held.theta = held.x;
  return held;
}

/// s of lag_damping.h, in the inner three fifths of a strip.
double share_of(const Scene& scene, const ddem::Assembly& a, const MacroStrain& strain, bool free_strip) {
  const ContactParameters contact = contact_parameters(scene);
  const DeformationParameters d = deformation_parameters(scene);
  const StaticSolver solver(a, contact, d, held_ends(a, edge_band(scene, a), !free_strip));
  const auto [lo, hi] = network_ends(a);
  const InnerSection section = a.packing.period.x > 0.0 ? InnerSection{lo, hi} : InnerSection{lo + 0.2 * (hi - lo), lo + 0.8 * (hi - lo)};
  try {
    return lag_share(a, solver, contact, d, fixed_point_radius(a, contact, d), strain, section);
  } catch (const std::invalid_argument& e) {
    throw InputError(scene.path.string() + ": [deformation]: " + e.what());
  }
}

}  // namespace

double WaveGrowth::phase_speed() const { return frequency * wavelength / (2.0 * std::numbers::pi); }

double WaveGrowth::growth_per_period(double time_step) const {
  return std::expm1(std::log1p(growth) * 2.0 * std::numbers::pi / (frequency * time_step));
}

double mean_normal_stiffness(const ddem::Assembly& a, const ContactParameters& contact) {
  const std::vector<double> k_n = normal_stiffnesses(a, contact);
  return std::accumulate(k_n.begin(), k_n.end(), 0.0) / static_cast<double>(k_n.size());
}

HexagonalBloch bloch_of(const Scene& scene, const ddem::Assembly& a, const ContactParameters& contact, const DeformationParameters& deformation) {
  const auto& packing = std::get<HexagonalPacking>(scene.assembly.packing);
  const double angle = packing.close_packed_along == Axis::x ? 0.0 : 0.5 * std::numbers::pi;
  ContactParameters uniform = contact;
  uniform.normal_stiffness = mean_normal_stiffness(a, contact);
  uniform.contact_modulus = 0.0;
  return {{a.packing.radius.front(), a.density, a.thickness, angle}, uniform, deformation};
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
  const bool periodic = scene.assembly.periodic.y, lagged = deformation_parameters(scene).scheme == Scheme::lagged;
  const SceneModuli moduli = scene_moduli(scene);
  const auto shear = moduli.speed_of(Wave::shear, periodic), longitudinal = moduli.speed_of(Wave::longitudinal, periodic);
  double shear_share = 0.0, longitudinal_share = 0.0;
  if (lagged) {
    const ddem::Assembly a = build_assembly(scene);
    longitudinal_share = share_of(scene, a, kStretch, !periodic);
    // Statics take the shear modulus of a free strip from its laterally closed counterpart.
    if (shear) shear_share = share_of(scene, periodic ? a : build_laterally_closed(scene).assembly.value(), kShear, false);
  }
  std::vector<WaveGrowth> waves;
  const auto add = [&](const char* name, double wavelength, const std::optional<double>& speed, double share) {
    if (!speed) return;
    const double omega = 2.0 * std::numbers::pi / wavelength * *speed;
    waves.push_back({name, wavelength, omega, -0.5 * omega * dt * omega * dt * share, false});
  };
  for (const double wavelength : wavelengths) {
    add("shear", wavelength, shear, shear_share);
    add(periodic ? "p" : "bar", wavelength, longitudinal, longitudinal_share);
  }
  return waves;
}

}  // namespace ddem::harness
