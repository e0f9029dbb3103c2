#include "harness/model/load.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "harness/io/errors.h"
#include "harness/scene/csv.h"

namespace ddem::harness {
namespace {

constexpr double kGaussianReach = 3.0;  // standard widths: what is left is 1 % of the height

ddem::InitialState pulse_state(const Scene& scene, const InitialPulse& pulse, const ddem::Assembly& a) {
  ddem::InitialState state;
  auto& u = pulse.wave == Wave::longitudinal ? state.ux : state.uy;
  u.assign(a.size(), 0.0);
  if (pulse.shape == PulseShape::column) {
    for (const int d : discs_of_edge(scene, a, ddem::Edge::left)) u[d] = pulse.amplitude;
  } else {
    const auto [left, right] = network_ends(a);
    require_inside(scene, pulse, right - left);
    for (std::size_t d = 0; d < a.size(); ++d) u[d] = pulse_at(pulse, a.packing.x[d] - left);
  }
  settle_held_discs(scene, a, pulse, u);
  return state;
}

StateTable read_state(const Scene& scene, const ddem::Assembly& a, const std::string& key, const std::filesystem::path& path) {
  auto table = read_state_table(path);
  if (!table) {
    std::vector<std::string> lines;
    for (const Violation& v : table.violations) lines.push_back(to_string(v));
    throw InputError(lines);
  }
  if (table->ux.size() != a.size()) {
    throw InputError(path.string() + ": " + std::to_string(table->ux.size()) + " rows, but the assembly has " +
                      std::to_string(a.size()) + " discs; give one row a disc");
  }
  settle_held_discs(scene, a, key, path, *table.value);
  return std::move(*table.value);
}

}  // namespace

ddem::InitialState initial_state(const Scene& scene, const ddem::Assembly& a) {
  if (const auto* pulse = std::get_if<InitialPulse>(&scene.load)) return pulse_state(scene, *pulse, a);
  ddem::InitialState state;
  if (const auto* files = std::get_if<InitialState>(&scene.load)) {
    if (files->displacement) {
      StateTable t = read_state(scene, a, "initial.displacement", *files->displacement);
      state.ux = std::move(t.ux), state.uy = std::move(t.uy), state.theta = std::move(t.theta);
    }
    if (files->velocity) {
      StateTable t = read_state(scene, a, "initial.velocity", *files->velocity);
      state.vx = std::move(t.ux), state.vy = std::move(t.uy), state.omega = std::move(t.theta);
    }
  }
  return state;
}

std::optional<EdgeDrive> edge_drive(const Scene& scene, const ddem::Assembly& a) {
  const auto* drive = std::get_if<Drive>(&scene.load);
  if (drive == nullptr) return std::nullopt;
  EdgeDrive edge{discs_of_edge(scene, a, ddem::Edge::left),
                 drive->wave == Wave::longitudinal ? Direction::x : Direction::y, drive->amplitude, drive->duration};
  check_held_drive(scene, a, edge);
  return edge;
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

std::optional<double> source_reach(const Scene& scene) {
  const auto* pulse = std::get_if<InitialPulse>(&scene.load);
  if (pulse == nullptr || pulse->shape == PulseShape::column) return std::nullopt;
  return pulse->shape == PulseShape::gaussian ? kGaussianReach * pulse->width : pulse->width;
}

double source_amplitude(const Scene& scene) {
  if (const auto* pulse = std::get_if<InitialPulse>(&scene.load)) return pulse->amplitude;
  if (const auto* drive = std::get_if<Drive>(&scene.load)) return drive->amplitude;
  return 0.0;
}

double pulse_half_width(const Scene& scene, double speed) {
  if (std::holds_alternative<Drive>(scene.load)) return 0.5 * source_duration(scene);
  return source_reach(scene).value_or(0.0) / speed;
}

double pulse_width(const Scene& scene, double speed) {
  const double half = pulse_half_width(scene, speed);  // at half its height a squared sine is half as wide as at its foot
  const auto* pulse = std::get_if<InitialPulse>(&scene.load);
  const bool gaussian = pulse != nullptr && pulse->shape == PulseShape::gaussian;
  return gaussian ? half / kGaussianReach * std::sqrt(8.0 * std::numbers::ln2) : half;
}

double smallest_arrival(const Scene& scene) {
  const auto* pulse = std::get_if<InitialPulse>(&scene.load);
  return pulse != nullptr && pulse->shape == PulseShape::column ? 0.01 : 0.05;
}

}  // namespace ddem::harness
