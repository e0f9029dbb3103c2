#include "harness/model/load.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "harness/io/errors.h"
#include "harness/model/assemble.h"
#include "harness/scene/csv.h"

namespace ddem::harness {
namespace {

double profile(const InitialPulse& p, double s) {
  switch (p.shape) {
    case PulseShape::column: return 0.0;  // by discs, not by distance
    case PulseShape::cosine:
      return s < p.width ? 0.5 * p.amplitude * (1.0 + std::cos(std::numbers::pi * s / p.width)) : 0.0;
    case PulseShape::gaussian: {
      const double z = (s - p.center) / p.width;
      return p.amplitude * std::exp(-0.5 * z * z);
    }
  }
  return 0.0;
}

ddem::InitialState pulse_state(const Scene& scene, const InitialPulse& pulse, const ddem::Assembly& a) {
  ddem::InitialState state;
  auto& u = pulse.wave == Wave::longitudinal ? state.ux : state.uy;
  u.assign(a.size(), 0.0);
  if (pulse.shape == PulseShape::column) {
    for (const int d : edge_discs(a.packing, ddem::Edge::left, edge_band(scene, a))) u[d] = pulse.amplitude;
    return state;
  }
  const double left = *std::min_element(a.packing.x.begin(), a.packing.x.end());
  for (std::size_t d = 0; d < a.size(); ++d) u[d] = profile(pulse, a.packing.x[d] - left);
  return state;
}

StateTable read_state(const std::filesystem::path& path, std::size_t discs) {
  auto table = read_state_table(path);
  if (!table) {
    std::vector<std::string> lines;
    for (const Violation& v : table.violations) lines.push_back(to_string(v));
    throw InputError(lines);
  }
  if (table->ux.size() != discs) {
    throw InputError(path.string() + ": " + std::to_string(table->ux.size()) + " rows, but the assembly has " +
                      std::to_string(discs) + " discs; give one row a disc");
  }
  return *table;
}

void hold(HeldDofs& held, const std::vector<int>& discs, std::size_t n, Edge edge) {
  if (edge == Edge::free) return;
  for (auto* mask : {&held.x, &held.y, &held.theta}) {
    if (mask->empty()) mask->assign(n, 0);
  }
  for (const int d : discs) {
    held.x[d] = 1;
    if (edge == Edge::fixed) held.y[d] = held.theta[d] = 1;
  }
}

}  // namespace

HeldDofs held_dofs(const Scene& scene, const ddem::Assembly& a) {
  HeldDofs held;
  const double band = edge_band(scene, a);
  hold(held, edge_discs(a.packing, ddem::Edge::right, band), a.size(), scene.boundary.right);
  hold(held, edge_discs(a.packing, ddem::Edge::left, band), a.size(), scene.boundary.left);
  return held;
}

ddem::InitialState initial_state(const Scene& scene, const ddem::Assembly& a) {
  if (const auto* pulse = std::get_if<InitialPulse>(&scene.load)) return pulse_state(scene, *pulse, a);
  ddem::InitialState state;
  if (const auto* files = std::get_if<InitialState>(&scene.load)) {
    if (files->displacement) {
      StateTable t = read_state(*files->displacement, a.size());
      state.ux = std::move(t.ux), state.uy = std::move(t.uy), state.theta = std::move(t.theta);
    }
    if (files->velocity) {
      StateTable t = read_state(*files->velocity, a.size());
      state.vx = std::move(t.ux), state.vy = std::move(t.uy), state.omega = std::move(t.theta);
    }
  }
  return state;
}

std::optional<EdgeDrive> edge_drive(const Scene& scene, const ddem::Assembly& a) {
  const auto* drive = std::get_if<Drive>(&scene.load);
  if (drive == nullptr) return std::nullopt;
  return EdgeDrive{edge_discs(a.packing, ddem::Edge::left, edge_band(scene, a)),
                   drive->wave == Wave::longitudinal ? Direction::x : Direction::y, drive->amplitude, drive->duration};
}

std::optional<Wave> wave_of(const Scene& scene) {
  if (const auto* pulse = std::get_if<InitialPulse>(&scene.load)) return pulse->wave;
  if (const auto* drive = std::get_if<Drive>(&scene.load)) return drive->wave;
  return std::nullopt;
}

double source_duration(const Scene& scene) {
  const auto* drive = std::get_if<Drive>(&scene.load);
  return drive != nullptr ? drive->duration : 0.0;
}

double source_centre(const Scene& scene) {
  const auto* pulse = std::get_if<InitialPulse>(&scene.load);
  return pulse != nullptr && pulse->shape == PulseShape::gaussian ? pulse->center : 0.0;
}

double source_amplitude(const Scene& scene) {
  if (const auto* pulse = std::get_if<InitialPulse>(&scene.load)) return std::abs(pulse->amplitude);
  if (const auto* drive = std::get_if<Drive>(&scene.load)) return std::abs(drive->amplitude);
  return 0.0;
}

double pulse_half_width(const Scene& scene, double speed) {
  const auto* pulse = std::get_if<InitialPulse>(&scene.load);
  if (pulse == nullptr) return 0.5 * source_duration(scene);
  switch (pulse->shape) {
    case PulseShape::column: return 0.0;
    case PulseShape::cosine: return pulse->width / speed;
    case PulseShape::gaussian: return 3.0 * pulse->width / speed;
  }
  return 0.0;
}

double smallest_arrival(const Scene& scene) {
  const auto* pulse = std::get_if<InitialPulse>(&scene.load);
  return pulse != nullptr && pulse->shape == PulseShape::column ? 0.01 : 0.05;
}

}  // namespace ddem::harness
