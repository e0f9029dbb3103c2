#include "harness/bench/lattice_pulse.h"

#include <cmath>
#include <numbers>

#include "dem/spectra/bloch.h"
#include "harness/references/effective_moduli.h"

namespace ddem::harness::bench {
namespace {

constexpr double kPulseAmplitude = 1e-9;    // m
constexpr double kSmallestShare = 8.0; // exp(-8^2/2) = 1e-14: shorter waves are not there

double closed_form_speed(const Law& law) {
  const bool rigid = !law.deformation.active();
  const auto moduli = references::effective_moduli(
      rigid ? references::ContactModel::dem : references::ContactModel::ddem_full, references::hexagonal_fabric(),
      {law.contact.normal_stiffness, law.contact.stiffness_ratio},
      {{rigid ? 1.0 : law.deformation.young_modulus, law.deformation.poisson_ratio}, 1.0});
  return std::sqrt(moduli.shear / (kDensity * references::hexagonal_fabric().solid_fraction));
}

}  // namespace

LatticePulse::LatticePulse(const Law& law, int columns, double radius, double width)
    : length_(2.0 * radius * columns), middle_(0.5 * length_), speed_(closed_form_speed(law)) {
  const HexagonalBloch bloch({radius, kDensity, 1.0, 0.0}, law.contact, law.deformation);
  const double mean = kPulseAmplitude * width * std::sqrt(2.0 * std::numbers::pi) / length_;
  modes_.push_back({0.0, mean, 0.0, 0.0, 0.0, 0.0});
  for (int n = 1; n < columns; ++n) {
    const double k = 2.0 * std::numbers::pi * n / length_;
    if (k * width > kSmallestShare) break;
    // Shear along the rows is the slowest branch. Motions are (u_x, u_y, r theta/sqrt 2) times the root of the mass.
    const Branch shear = bloch.branches({k, 0.0}).front();
    const std::complex<double> rotation =
        shear.motion.size() > 2 ? std::numbers::sqrt2 * shear.motion[2] / shear.motion[1] / radius : 0.0;
    modes_.push_back({k, 2.0 * mean * std::exp(-0.5 * k * width * k * width), shear.frequency.real(), k * speed_,
                      rotation.real(), -rotation.imag()});
  }
}

ddem::InitialState LatticePulse::start(const ddem::Assembly& a) const {
  ddem::InitialState state;
  for (const double x : a.packing.x) {
    double theta = 0.0;
    for (const Mode& m : modes_) {
      const double phase = m.wave_number * (x - middle_);
      theta += m.amplitude * (m.rotation_cosine * std::cos(phase) + m.rotation_sine * std::sin(phase));
    }
    state.uy.push_back(lattice(x, 0.0));
    state.theta.push_back(theta);
  }
  return state;
}

double LatticePulse::sum(double x, double t, double Mode::* frequency) const {
  double u = 0.0;
  for (const Mode& m : modes_) u += m.amplitude * std::cos(m.wave_number * (x - middle_)) * std::cos(m.*frequency * t);
  return u;
}

}  // namespace ddem::harness::bench
