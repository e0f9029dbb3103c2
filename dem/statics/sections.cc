#include "dem/statics/sections.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace ddem {
namespace {

/// The ends moved against each other along x (component 0) or y (1): the left band stays, the right one moves by 1. As in
/// a driven strip with a right end fixed in x, nothing else is held, so that no other force passes through.
HeldDofs held_under(const Assembly& a, double edge_band, int component) {
  HeldDofs held;
  std::vector<std::uint8_t>& moved = component == 0 ? held.x : held.y;
  moved.assign(a.size(), 0);
  for (const int d : edge_discs(a, Edge::left, edge_band)) moved[d] = 1;
  if (component == 1) held.x.assign(a.size(), 0);
  for (const int d : edge_discs(a, Edge::right, edge_band)) moved[d] = held.x[d] = 1;
  return held;
}

StaticState pulled(const Assembly& a, const ContactParameters& contact, const DeformationParameters& deformation,
                   double edge_band, int component) {
  const StaticSolver solver(a, contact, deformation, held_under(a, edge_band, component));
  return solver.solve_moved(right_end_moved(a, edge_band, component, solver.operators().dofs_per_disc));
}

/// Force that the part right of the plane x = cut exerts on the part left of it.
Eigen::Vector2d force_through(const Assembly& a, const OperatorFrame& op, const StaticState& state, double cut) {
  Eigen::Vector2d force = Eigen::Vector2d::Zero();
  for (std::size_t c = 0; c < a.bonds.size(); ++c) {
    const double x_i = a.packing.x[a.bonds.i[c]], x_j = x_i + a.bonds.length[c] * a.bonds.nx[c];
    if ((x_i < cut) == (x_j < cut)) continue;
    force += (x_i < cut ? 1.0 : -1.0) * bond_force(a.bonds, op, state, c);
  }
  return force;
}

/// Share of a disc's area left of a plane at `distance` from its centre (in radii, positive to the right).
double share_left(double distance) {
  const double z = std::clamp(distance, -1.0, 1.0);
  return 0.5 + (z * std::sqrt(1.0 - z * z) + std::asin(z)) / std::numbers::pi;
}

double moving_mass_before(const Assembly& a, double x) {
  double sum = 0.0;
  for (const int d : network_discs(a)) sum += a.mass[d] * share_left((x - a.packing.x[d]) / a.packing.radius[d]);
  return sum;
}

double middle(const Packing& p) {
  const auto [lo, hi] = std::minmax_element(p.x.begin(), p.x.end());
  return 0.5 * (*lo + *hi);
}

Eigen::Vector2d mean_displacement(const SectionDiscs& section, const StaticState& state, int dofs_per_disc) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const int d : section) sum += state.fluctuation.segment<2>(static_cast<Eigen::Index>(dofs_per_disc) * d);
  return sum / static_cast<double>(section.size());
}

void require_valid(const std::vector<SectionDiscs>& sections, std::size_t discs) {
  for (const SectionDiscs& section : sections) {
    if (section.empty()) throw std::invalid_argument("a section needs at least one disc");
    for (const int d : section) {
      if (d < 0 || static_cast<std::size_t>(d) >= discs) {
        throw std::invalid_argument("a section's disc " + std::to_string(d) + " does not exist");
      }
    }
  }
}

}  // namespace

StaticSections::Speeds StaticSections::between(int from, int to) const {
  const double distance = x.at(to) - x.at(from);
  if (!(distance > 0.0)) throw std::invalid_argument("the second section must lie behind the first");
  const Eigen::Matrix2d s = displacement[to] - displacement[from];
  const double mass = mass_before[to] - mass_before[from];
  const auto speed = [&](double compliance) {
    if (!(compliance > 0.0)) {
      throw std::runtime_error("the compliance between two sections is not positive: they lie too close together, or to an end");
    }
    return distance / std::sqrt(mass * compliance);
  };
  if (!periodic) return {0.0, 0.0, speed(s(0, 0))};
  // Real for a symmetric S, and for the asymmetry of two sections' scatter as long as S and P differ by more than that.
  const double mean = 0.5 * s.trace(), difference = 0.5 * (s(1, 1) - s(0, 0));
  const double root = std::sqrt(difference * difference + s(0, 1) * s(1, 0));
  return {speed(mean - root), speed(mean + root), 0.0};
}

Eigen::VectorXd right_end_moved(const Assembly& a, double edge_band, int component, int dofs_per_disc) {
  Eigen::VectorXd q = Eigen::VectorXd::Zero(dofs_per_disc * static_cast<Eigen::Index>(a.size()));
  for (const int d : edge_discs(a, Edge::right, edge_band)) q[static_cast<Eigen::Index>(dofs_per_disc) * d + component] = 1.0;
  return q;
}

StaticSections sections_under(const Assembly& a, const OperatorFrame& op, std::span<const StaticState> loads,
                              const std::vector<SectionDiscs>& sections) {
  require_valid(sections, a.size());
  StaticSections out;
  out.periodic = a.packing.period.y > 0.0;
  const double cut = middle(a.packing);
  Eigen::Matrix2d forces = Eigen::Matrix2d::Identity();
  for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(loads.size()); ++k) forces.col(k) = force_through(a, op, loads[k], cut);
  if (loads.size() == 1) forces(1, 0) = 0.0;
  const Eigen::Matrix2d inverse = forces.inverse();
  for (const SectionDiscs& section : sections) {
    double sum = 0.0;
    for (const int d : section) sum += a.packing.x[d];
    out.x.push_back(sum / static_cast<double>(section.size()));
    out.mass_before.push_back(moving_mass_before(a, out.x.back()));
    Eigen::Matrix2d displacement = Eigen::Matrix2d::Zero();
    for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(loads.size()); ++k) {
      displacement.col(k) = mean_displacement(section, loads[k], op.dofs_per_disc);
    }
    out.displacement.push_back(displacement * inverse);
  }
  return out;
}

StaticSections static_sections(const Assembly& a, const ContactParameters& contact,
                               const DeformationParameters& deformation, double edge_band,
                               const std::vector<SectionDiscs>& sections) {
  require_valid(sections, a.size());
  std::vector<StaticState> loads;
  for (int k = 0; k < (a.packing.period.y > 0.0 ? 2 : 1); ++k) loads.push_back(pulled(a, contact, deformation, edge_band, k));
  return sections_under(a, operator_frame(a, contact, deformation), loads, sections);
}

std::vector<double> static_compliances(const Assembly& a, const ContactParameters& contact,
                                       const DeformationParameters& deformation, double edge_band,
                                       const std::vector<SectionDiscs>& sections, int component) {
  require_valid(sections, a.size());
  const StaticState state = pulled(a, contact, deformation, edge_band, component);
  const OperatorFrame op = operator_frame(a, contact, deformation);
  const double force = force_through(a, op, state, middle(a.packing))[component];
  std::vector<double> compliances;
  for (const SectionDiscs& s : sections) compliances.push_back(mean_displacement(s, state, op.dofs_per_disc)[component] / force);
  return compliances;
}

}  // namespace ddem
