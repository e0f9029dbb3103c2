#include "harness/model/held_edges.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "harness/io/errors.h"
#include "harness/model/assemble.h"
#include "harness/scene/place.h"

namespace ddem::harness {
namespace {

constexpr double kTail = 1e-6, kRoundOff = 1e-12;
constexpr std::size_t kMostListed = 20;

enum Component { along_x, along_y, rotation };

bool holds(Edge edge, Component c) { return edge == Edge::fixed || (edge == Edge::fixed_x && c == along_x); }

Component component_of(const InitialPulse& pulse) { return pulse.wave == Wave::longitudinal ? along_x : along_y; }

struct HeldEdge {
  const char* name;  // right, left
  Edge edge;
  std::vector<int> discs;

  std::string key() const { return fmt::format("boundary.{}", name); }
  std::string text(const Scene& scene) const {
    return fmt::format("{} = \"{}\"{}", key(), edge == Edge::fixed ? "fixed" : "fixed_x", scene.places.contains(key()) ? "" : " (the default)");
  }
  std::string freed() const { return fmt::format("{} = \"free\" in [boundary]", name); }
};

std::vector<HeldEdge> held_edges(const Scene& scene, const ddem::Assembly& a) {
  std::vector<HeldEdge> held;
  if (scene.boundary.right != Edge::free) held.push_back({"right", scene.boundary.right, discs_of_edge(scene, a, ddem::Edge::right)});
  if (scene.boundary.left != Edge::free) held.push_back({"left", scene.boundary.left, discs_of_edge(scene, a, ddem::Edge::left)});
  return held;
}

std::string remedy_for(const InitialPulse& pulse, const HeldEdge& edge) {
  switch (pulse.shape) {
    case PulseShape::column: return "use a longer strip, or a smaller assembly.edge_band";
    case PulseShape::cosine: return "use a narrower pulse, or " + edge.freed();
    case PulseShape::gaussian: return "use a narrower pulse, another center, or " + edge.freed();
  }
  return "";
}

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double v : values) most = std::max(most, std::abs(v));
  return most;
}

}  // namespace

std::vector<int> discs_of_edge(const Scene& scene, const ddem::Assembly& a, ddem::Edge edge) {
  const double band = edge_band(scene, a);
  return network_discs(a).empty() ? edge_discs(a.packing, edge, band) : edge_discs(a, edge, band);
}

HeldDofs held_dofs(const Scene& scene, const ddem::Assembly& a) {
  HeldDofs held;
  for (const HeldEdge& e : held_edges(scene, a)) {
    for (const auto& [mask, component] : {std::pair(&held.x, along_x), std::pair(&held.y, along_y), std::pair(&held.theta, rotation)}) {
      mask->resize(a.size(), 0);
      if (!holds(e.edge, component)) continue;
      for (const int d : e.discs) (*mask)[d] = 1;
    }
  }
  return held;
}

void settle_held_discs(const Scene& scene, const ddem::Assembly& a, const InitialPulse& pulse, std::vector<double>& u) {
  for (const HeldEdge& e : held_edges(scene, a)) {
    if (!holds(e.edge, component_of(pulse))) continue;
    const int most = *std::max_element(e.discs.begin(), e.discs.end(), [&](int i, int j) { return std::abs(u[i]) < std::abs(u[j]); });
    if (std::abs(u[most]) > kTail * std::abs(pulse.amplitude)) {
      throw InputError(scene_problem(scene, pulse.shape == PulseShape::column ? "initial.shape" : "initial.width",
                                     fmt::format("the pulse displaces disc {} by {:.3g} m, which {} holds", most, u[most], e.text(scene)),
                                     remedy_for(pulse, e)));
    }
    for (const int d : e.discs) u[d] = 0.0;
  }
}

void settle_held_discs(const Scene& scene, const ddem::Assembly& a, const std::string& key, const std::filesystem::path& file, StateTable& state) {
  std::vector<std::string> lines;
  for (const HeldEdge& e : held_edges(scene, a)) {
    for (const auto& [values, component, name] : {std::tuple(&state.ux, along_x, "ux"), std::tuple(&state.uy, along_y, "uy"), std::tuple(&state.theta, rotation, "theta")}) {
      if (!holds(e.edge, component)) continue;
      const double round_off = kRoundOff * largest(*values);
      for (const int d : e.discs) {
        double& value = (*values)[d];
        if (std::abs(value) > round_off) {
          lines.push_back(to_string(Violation{file.string(), state.line[d], 0, name, fmt::format("{:.6g}", value),
                                              fmt::format("{} moves disc {}, which {} holds", key, d, e.text(scene)),
                                              fmt::format("write 0, or {}", e.freed())}));
        }
        value = 0.0;
      }
    }
  }
  if (lines.empty()) return;
  if (lines.size() > kMostListed) {
    const std::size_t more = lines.size() - kMostListed;
    lines.resize(kMostListed);
    lines.push_back(fmt::format("{}: and {} more", file.string(), more));
  }
  throw InputError(lines);
}

void check_held_ends(const Scene& scene, const InitialPulse& pulse, double length) {
  if (pulse.shape == PulseShape::column) return;
  for (const auto& [e, s] : {std::pair(HeldEdge{"right", scene.boundary.right, {}}, length), std::pair(HeldEdge{"left", scene.boundary.left, {}}, 0.0)}) {
    if (!holds(e.edge, component_of(pulse)) || std::abs(pulse_at(pulse, s)) <= kTail * std::abs(pulse.amplitude)) continue;
    throw InputError(scene_problem(scene, "initial.width",
                                   fmt::format("the pulse displaces the {} edge by {:.3g} m, which {} holds", e.name, pulse_at(pulse, s), e.text(scene)),
                                   remedy_for(pulse, e)));
  }
}

void require_inside(const Scene& scene, const InitialPulse& pulse, double length) {
  if (pulse.shape != PulseShape::gaussian) return;
  const double most = std::abs(pulse_at(pulse, std::clamp(pulse.center, 0.0, length)));
  if (most > kTail * std::abs(pulse.amplitude)) return;
  throw InputError(scene_problem(scene, "initial.center", fmt::format("the pulse lies beside the strip, which is {:.6g} m long: nothing moves", length),
                                 "let it start between 0 and that length"));
}

void check_held_drive(const Scene& scene, const ddem::Assembly& a, const EdgeDrive& drive) {
  for (const HeldEdge& e : held_edges(scene, a)) {
    if (!holds(e.edge, drive.direction == Direction::x ? along_x : along_y)) continue;
    for (const int d : drive.discs) {
      if (!std::binary_search(e.discs.begin(), e.discs.end(), d)) continue;
      throw InputError(scene_problem(scene, "drive.wave", fmt::format("[drive] moves disc {} of the left edge, which {} holds, too", d, e.text(scene)),
                                     fmt::format("use a longer strip, a smaller assembly.edge_band, or {}", e.freed())));
    }
  }
}

double pulse_at(const InitialPulse& p, double s) {
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

}  // namespace ddem::harness
