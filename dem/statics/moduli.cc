#include "dem/statics/moduli.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace ddem {
namespace {

constexpr std::array<MacroStrain, 3> kUnitStrains = {MacroStrain{1, 0, 0}, MacroStrain{0, 1, 0}, MacroStrain{0, 0, 1}};

/// Interval [from, to] of x between two inner sections.
struct Section {
  double from, to;
};

/// Weight of a cross-section in the mean stress: 1 between the sections, falling linearly to 0 at both ends over `ramp`. Rows
/// of bonds that stand across the strip carry sigma_yy in lumps; a sharp end would count one lump too many or too few.
class SectionWeight {
 public:
  SectionWeight(const Section& s, double ramp) : section_(s), ramp_(ramp) {}
  double length() const { return section_.to - section_.from - ramp_; }
  /// Mean over [x0, x1].
  double mean(double x0, double x1) const {
    return x0 == x1 ? value(x0) : (integral(x1) - integral(x0)) / (x1 - x0);
  }

 private:
  double value(double x) const { return std::clamp(std::min(x - section_.from, section_.to - x) / ramp_, 0.0, 1.0); }
  double integral(double x) const {
    const auto rise = [&](double s) { return s <= 0.0 ? 0.0 : s < ramp_ ? 0.5 * s * s / ramp_ : s - 0.5 * ramp_; };
    return rise(x - section_.from) - rise(x - section_.to + ramp_);
  }
  Section section_;
  double ramp_;
};

/// Mean stress (xx, yy, xy) between two sections from the bonds inside, weighted. xx and xy are the force through a
/// cross-section, the same through each in equilibrium, so exact whatever the weights; yy is a mean over the discs' rows.
Eigen::Vector3d mean_stress(const Assembly& a, const OperatorFrame& op, const StaticState& state, const Section& s) {
  const SectionWeight weight(s, 0.25 * (s.to - s.from));
  Eigen::Vector3d stress = Eigen::Vector3d::Zero();
  for (std::size_t c = 0; c < a.bonds.size(); ++c) {
    const double lx = a.bonds.length[c] * a.bonds.nx[c], ly = a.bonds.length[c] * a.bonds.ny[c];
    const double x0 = a.packing.x[a.bonds.i[c]];
    const Eigen::Vector2d f = bond_force(a.bonds, op, state, c);
    stress += weight.mean(x0, x0 + lx) * Eigen::Vector3d(lx * f.x(), ly * f.y(), lx * f.y());
  }
  return stress / (weight.length() * a.packing.width * a.thickness);
}

/// Of the network: measured between the sections at 1/5 and 4/5 of its length, each the mean of the discs within three mean
/// radii (a single column would carry the noise of single discs).
class StripGauge {
 public:
  explicit StripGauge(const Assembly& a) : packing_(a.packing), discs_(network_discs(a)) {
    double lo = HUGE_VAL, hi = -HUGE_VAL, radii = 0.0;
    for (const int d : discs_) {
      lo = std::min(lo, packing_.x[d]);
      hi = std::max(hi, packing_.x[d]);
      radii += packing_.radius[d];
    }
    const double band = 3.0 * radii / static_cast<double>(discs_.size());
    left_ = discs_near(lo + 0.2 * (hi - lo), band);
    right_ = discs_near(lo + 0.8 * (hi - lo), band);
    section_ = {mean(left_, packing_.x), mean(right_, packing_.x)};
    if (left_.empty() || right_.empty() || !(section_.to - section_.from > 2.0 * band)) {
      throw std::invalid_argument("the strip is too short for a static measurement between inner sections; use at least 30 discs along x");
    }
  }
  const Section& section() const { return section_; }

  /// Mean slope d(value)/dx between the sections; value = affine part * x + fluctuation.
  double slope(const StaticState& state, int dofs_per_disc, int component) const {
    const auto fluctuation = [&](const std::vector<int>& discs) {
      double sum = 0.0;
      for (const int d : discs) sum += state.fluctuation[dofs_per_disc * d + component];
      return sum / static_cast<double>(discs.size());
    };
    return (fluctuation(right_) - fluctuation(left_)) / (section_.to - section_.from);
  }

  /// du_y/dy between the sections by least squares over the discs there; none where they stand in one row.
  std::optional<double> lateral_strain(const StaticState& state, int dofs_per_disc) const {
    double n = 0, sy = 0, su = 0, syy = 0, syu = 0;
    const double origin = packing_.y[discs_.front()];
    for (const int d : discs_) {
      if (packing_.x[d] < section_.from || packing_.x[d] > section_.to) continue;
      const double y = packing_.y[d] - origin, u = state.fluctuation[dofs_per_disc * d + 1];
      n += 1, sy += y, su += u, syy += y * y, syu += y * u;
    }
    const double spread = std::sqrt(std::max(0.0, n * syy - sy * sy)) / n;
    if (!(spread > kOneRow * packing_.radius[discs_.front()])) return std::nullopt;
    return (n * syu - sy * su) / (n * syy - sy * sy);
  }

 private:
  /// Heights that differ by less, in radii, are those of one row with rounded coordinates.
  static constexpr double kOneRow = 1e-6;

  std::vector<int> discs_near(double x, double band) const {
    std::vector<int> discs;
    for (const int d : discs_) {
      if (std::abs(packing_.x[d] - x) <= band) discs.push_back(d);
    }
    return discs;
  }
  double mean(const std::vector<int>& discs, const std::vector<double>& value) const {
    double sum = 0.0;
    for (const int d : discs) sum += value[d];
    return discs.empty() ? 0.0 : sum / static_cast<double>(discs.size());
  }

  const Packing& packing_;
  std::vector<int> discs_, left_, right_;
  Section section_{};
};

/// Told before anything is factorised: grips that meet leave nothing to be solved.
const Assembly& with_inner_sections(const Assembly& a) {
  const StripGauge gauge(a);
  return a;
}

/// Between periodic edges the discs of both ends can do nothing of their own; between free ones they slide along the grips.
HeldDofs gripped_ends(const Assembly& a, double edge_band) {
  const Packing& p = a.packing;
  const bool hold_y_and_theta = p.period.y > 0.0;
  HeldDofs held;
  held.x.assign(p.size(), 0);
  if (hold_y_and_theta) {
    held.y.assign(p.size(), 0);
    held.theta.assign(p.size(), 0);
  }
  for (const Edge e : {Edge::left, Edge::right}) {
    for (const int d : edge_discs(a, e, edge_band)) {
      held.x[d] = 1;
      if (hold_y_and_theta) held.y[d] = held.theta[d] = 1;
    }
  }
  return held;
}

/// Mean strain of the fluctuation and mean stress: both linear in the state.
struct MeanResponse {
  Eigen::Vector3d strain, stress;
};

/// Without a gauge: of a periodic cell.
MeanResponse response(const Assembly& a, const OperatorFrame& op, const StaticState& state, const StripGauge* gauge) {
  if (gauge != nullptr) {
    const int dofs = op.dofs_per_disc;
    return {{gauge->slope(state, dofs, 0), 0.0, gauge->slope(state, dofs, 1)}, mean_stress(a, op, state, gauge->section())};
  }
  Eigen::Vector3d stress = Eigen::Vector3d::Zero();
  for (std::size_t b = 0; b < a.bonds.size(); ++b) {
    const Eigen::Vector2d f = bond_force(a.bonds, op, state, b);
    const double lx = a.bonds.length[b] * a.bonds.nx[b], ly = a.bonds.length[b] * a.bonds.ny[b];
    stress += Eigen::Vector3d(lx * f.x(), ly * f.y(), 0.5 * (lx * f.y() + ly * f.x()));
  }
  return {Eigen::Vector3d::Zero(), stress / (a.packing.period.x * a.packing.period.y * a.thickness)};
}

/// Rows xx and xy of a strip are exact, row yy is a mean: its coupling is that of the others.
void couple_as_exact_rows(PlaneStiffness& c) {
  c(0, 2) = c(2, 0) = 0.5 * (c(0, 2) + c(2, 0));
  c(1, 0) = c(0, 1);
  c(1, 2) = c(2, 1);
}

/// Rates of the operators, one a parameter. C = stress strain^-1 over three loads, dC = (d stress - C d strain) strain^-1. The affine shear moves u_x by y/2 and u_y
/// by x/2; the fluctuation adds to the part along x.
StiffnessRates homogenise(const Assembly& a, const StaticSolver& solver, const StripGauge* gauge,
                          std::span<const OperatorRates> operator_rate) {
  const OperatorFrame& op = solver.operators();
  const std::size_t parameters = operator_rate.size();
  Eigen::Matrix3d strain = Eigen::Matrix3d::Identity(), stress;
  std::vector<Eigen::Matrix3d> strain_rate(parameters), stress_rate(parameters);
  const std::vector<StaticState> states = solver.solve(kUnitStrains);
  for (int k = 0; k < 3; ++k) {
    const StaticState& state = states[k];
    const MeanResponse r = response(a, op, state, gauge);
    strain.col(k) += r.strain;
    stress.col(k) = r.stress;
    for (std::size_t p = 0; p < parameters; ++p) {
      const MeanResponse rate = response(a, op, solver.rate(state, operator_rate[p]), gauge);
      strain_rate[p].col(k) = rate.strain;
      stress_rate[p].col(k) = rate.stress;
    }
  }
  const Eigen::Matrix3d inverse = strain.inverse();
  StiffnessRates out{stress * inverse, {}};
  for (std::size_t p = 0; p < parameters; ++p) {
    out.rates.push_back((stress_rate[p] - out.stiffness * strain_rate[p]) * inverse);
    if (gauge != nullptr) couple_as_exact_rows(out.rates.back());
  }
  if (gauge != nullptr) couple_as_exact_rows(out.stiffness);
  return out;
}

}  // namespace

IsotropicModuli isotropic_part(const PlaneStiffness& c) {
  const double c12 = 0.5 * (c(0, 1) + c(1, 0));
  return {(c(0, 0) + c(1, 1) + 2.0 * c12) / 4.0, (c(0, 0) + c(1, 1) - 2.0 * c12 + 4.0 * c(2, 2)) / 8.0};
}

StiffnessRates homogenise_with_rates(const Assembly& a, const ContactParameters& contact,
                                     const DeformationParameters& deformation, double edge_band,
                                     std::span<const Parameter> parameters) {
  const bool cell = a.packing.period.x > 0.0 && a.packing.period.y > 0.0;
  const StaticSolver solver(a, contact, deformation, cell ? HeldDofs{} : gripped_ends(a, edge_band));
  std::vector<OperatorRates> rates;
  for (const Parameter p : parameters) rates.push_back(operator_rates(solver.operators(), contact, deformation, p));
  if (cell) return homogenise(a, solver, nullptr, rates);
  const StripGauge gauge(a);
  return homogenise(a, solver, &gauge, rates);
}

PlaneStiffness homogenise_cell(const Assembly& a, const ContactParameters& contact,
                               const DeformationParameters& deformation) {
  if (a.packing.period.x <= 0.0 || a.packing.period.y <= 0.0) {
    throw std::invalid_argument("homogenisation of a cell needs periods in x and y");
  }
  return homogenise_with_rates(a, contact, deformation, 0.0, {}).stiffness;
}

double StripTension::bar_velocity() const { return std::sqrt(axial_stiffness / mass_per_length); }

GrippedStrip::GrippedStrip(const Assembly& a, const ContactParameters& contact,
                           const DeformationParameters& deformation, double edge_band)
    : assembly_(with_inner_sections(a)), edge_band_(edge_band), solver_(a, contact, deformation, gripped_ends(a, edge_band)) {}

PlaneStiffness GrippedStrip::stiffness() const {
  if (!(assembly_.packing.period.y > 0.0)) throw std::invalid_argument("homogenisation of a strip needs a period in y");
  const StripGauge gauge(assembly_);
  return homogenise(assembly_, solver_, &gauge, {}).stiffness;
}

StripTension GrippedStrip::tension() const {
  if (assembly_.packing.period.y > 0.0) throw std::invalid_argument("the tension of a strip needs free edges");
  const StripGauge gauge(assembly_);
  const int dofs = solver_.operators().dofs_per_disc;
  const StaticState state = solver_.solve({1, 0, 0});
  const double strain = 1.0 + gauge.slope(state, dofs, 0), area = assembly_.packing.width * assembly_.thickness;
  const double force = mean_stress(assembly_, solver_.operators(), state, gauge.section())[0] * area;
  StripTension tension{force / strain, moving_density(assembly_) * area, std::nullopt};
  // What refinement leaves of a mechanism's forces; soft discs leave the millionth part of a bond's.
  const double nothing = 1e-12 * solver_.operators().stiffness.maxCoeff() * solver_.operators().length_scale;
  if (!(tension.axial_stiffness > nothing)) throw std::runtime_error("the strip resists no tension: it has a mechanism; take more rows or bonds, or a period in y");
  if (const auto lateral = gauge.lateral_strain(state, dofs)) tension.lateral_contraction = -*lateral / strain;
  return tension;
}

StaticSections GrippedStrip::sections(const std::vector<SectionDiscs>& sections) const {
  const int dofs = solver_.operators().dofs_per_disc;
  std::vector<StaticState> loads;
  for (int component = 0; component < (assembly_.packing.period.y > 0.0 ? 2 : 1); ++component) {
    loads.push_back(solver_.solve_moved(right_end_moved(assembly_, edge_band_, component, dofs)));
  }
  return sections_under(assembly_, solver_.operators(), loads, sections);
}

PlaneStiffness homogenise_strip(const Assembly& a, const ContactParameters& contact,
                                const DeformationParameters& deformation, double edge_band) {
  return GrippedStrip(a, contact, deformation, edge_band).stiffness();
}

StripTension pull_strip(const Assembly& a, const ContactParameters& contact,
                        const DeformationParameters& deformation, double edge_band) {
  return GrippedStrip(a, contact, deformation, edge_band).tension();
}

DirectionalSpeeds directional_speeds(const PlaneStiffness& c, double moving_density) {
  const PlaneStiffness compliance = c.inverse();
  return {std::sqrt(c(0, 0) / moving_density), std::sqrt(c(2, 2) / moving_density),
          std::sqrt(1.0 / (compliance(0, 0) * moving_density))};
}

}  // namespace ddem
