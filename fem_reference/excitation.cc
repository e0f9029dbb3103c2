#include "fem_reference/excitation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ddem::fem {
namespace {

using std::numbers::pi;

double profile(const InitialPulse& pulse, double s) {
  switch (pulse.shape) {
    case Shape::column:
      return pulse.amplitude * std::max(0.0, 1.0 - s / pulse.spacing);
    case Shape::cosine:
      return s < pulse.width ? 0.5 * pulse.amplitude * (1.0 + std::cos(pi * s / pulse.width)) : 0.0;
    case Shape::gaussian:
      return pulse.amplitude * std::exp(-0.5 * std::pow((s - pulse.center) / pulse.width, 2));
    case Shape::standing:
      break;
  }
  return 0.0;
}

// cos(sqrt z) and sin(sqrt z)/sqrt z, real for z of either sign.
double entire_cosine(double z) {
  return z >= 0.0 ? std::cos(std::sqrt(z)) : std::cosh(std::sqrt(-z));
}

double entire_sine(double z) {
  const double root = std::sqrt(std::abs(z));
  if (root < 1e-4) return 1.0 - z / 6.0;
  return z > 0.0 ? std::sin(root) / root : std::sinh(root) / root;
}

// The symmetric wave from the potentials phi = a cos(p y) cos(k x), psi = b sin(q y) sin(k x), p^2 = (w/c_p)^2 - k^2,
// q^2 = (w/c_s)^2 - k^2, y from the middle (Graff, Wave motion in elastic solids, section 8.1); the ratio of a to b q
// is that without shear stress at y = half_width, and there is no normal stress if k and w fulfil Rayleigh and Lamb's
// equation. Amplitude 1 is that of ux in the middle.
class StandingWave {
 public:
  StandingWave(const StripCase& strip, const InitialPulse& pulse)
      : k_(pi * pulse.half_waves / strip.length), half_width_(0.5 * strip.width) {
    const PlaneMaterial m = plane_material(strip.young_modulus, strip.poisson_ratio, strip.density, strip.plane);
    const double w2 = std::pow(k_ * pulse.phase_speed, 2);
    p2_ = w2 * m.density / (m.lame_lambda + 2.0 * m.shear_modulus) - k_ * k_;
    q2_ = w2 * m.density / m.shear_modulus - k_ * k_;
    const double h2 = half_width_ * half_width_;
    a_ = (q2_ - k_ * k_) * entire_sine(q2_ * h2);
    bq_ = 2.0 * k_ * p2_ * entire_sine(p2_ * h2);
    const double scale = 1.0 / (bq_ - k_ * a_);
    a_ *= scale;
    bq_ *= scale;
  }

  std::array<double, 2> operator()(double x, double y_from_bottom) const {
    const double y = y_from_bottom - half_width_, y2 = y * y;
    const double ux = bq_ * entire_cosine(q2_ * y2) - k_ * a_ * entire_cosine(p2_ * y2);
    const double uy = -a_ * p2_ * y * entire_sine(p2_ * y2) - k_ * bq_ * y * entire_sine(q2_ * y2);
    return {ux * std::sin(k_ * x), uy * std::cos(k_ * x)};
  }

 private:
  double k_, half_width_, p2_ = 0.0, q2_ = 0.0, a_ = 0.0, bq_ = 0.0;
};

// Calls hold(degree of freedom) for what the ends fix.
template <typename Hold>
void for_held(const StripCase& strip, const StripModel& model, const Hold& hold) {
  const auto hold_end = [&](End end, const std::vector<std::uint32_t>& nodes) {
    for (const std::uint32_t node : nodes) {
      if (end != End::free) hold(2 * std::size_t{node});
      if (end == End::fixed) hold(2 * std::size_t{node} + 1);
    }
  };
  hold_end(strip.left, model.left_nodes);
  hold_end(strip.right, model.right_nodes);
}

}  // namespace

int component(Wave wave) {
  return wave == Wave::longitudinal ? 0 : 1;
}

std::vector<double> inverse_mass(const StripCase& strip, const StripModel& model, const ElasticOperator& stiffness) {
  std::vector<double> inverse(stiffness.vector_size(), 0.0);
  for (std::size_t node = 0; node < stiffness.node_count(); ++node) {
    inverse[2 * node] = inverse[2 * node + 1] = 1.0 / stiffness.mass()[node];
  }
  for_held(strip, model, [&](std::size_t k) { inverse[k] = 0.0; });
  if (strip.drive) {
    for (const std::uint32_t node : model.left_nodes) inverse[2 * node + component(strip.drive->wave)] = 0.0;
  }
  return inverse;
}

std::vector<double> initial_field(const StripCase& strip, const StripModel& model, const InitialPulse& pulse) {
  std::vector<double> u(2 * (model.mesh.node_count + 1), 0.0);
  if (pulse.shape == Shape::standing) {
    const StandingWave wave(strip, pulse);
    for (std::size_t node = 0; node < model.mesh.node_count; ++node) {
      const auto [ux, uy] = wave(model.x[node], model.y[node]);
      u[2 * node] = pulse.amplitude * ux;
      u[2 * node + 1] = pulse.amplitude * uy;
    }
  } else {
    for (std::size_t node = 0; node < model.mesh.node_count; ++node) {
      u[2 * node + component(pulse.wave)] = profile(pulse, model.x[node]);
    }
  }
  for_held(strip, model, [&](std::size_t k) { u[k] = 0.0; });
  return u;
}

std::vector<double> driven_edge(const StripCase& strip, const StripModel& model, const ElasticOperator& stiffness) {
  std::vector<double> edge(stiffness.vector_size(), 0.0);
  for (const std::uint32_t node : model.left_nodes) edge[2 * node + component(strip.drive->wave)] = 1.0;
  return edge;
}

Sin2 motion(const EdgeDrive& drive) {
  return {drive.duration};
}

}  // namespace ddem::fem
