#include "harness/calibrate/target.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <charconv>
#include <cmath>
#include <vector>

#include "dem/spectra/dense_eigen.h"
#include "harness/io/errors.h"
#include "harness/references/plane_elasticity.h"

namespace ddem::harness {
namespace {

/// Of a value given without one, where more than two have to agree: three of them are 1 %.
constexpr double kAssumedUncertainty = 0.01 / 3.0;
constexpr double kAgreement = 3.0;  // standard deviations

/// A part of "30 GPa +- 1 GPa".
struct Part {
  double si = 0.0;
  bool has_unit = false;
};

Part parse_part(std::string_view option, std::string_view whole, std::string_view text, Dimension dimension) {
  const auto first = text.find_first_not_of(' ');
  text = first == std::string_view::npos ? std::string_view{}
                                         : text.substr(first, text.find_last_not_of(' ') - first + 1);
  const auto refuse = [&](const std::string& problem) {
    throw InputError(
        fmt::format("{} {}: {}; write {}", option, whole, problem, quantity_examples(dimension)));
  };
  Part part;
  const char* const end = text.data() + text.size();
  const auto [stop, problem] = std::from_chars(text.data(), end, part.si);
  if (problem == std::errc::result_out_of_range && stop == end) {
    const Magnitude m = magnitude_of(dimension);
    refuse(fmt::format("a {} other than 0 is from {:g} to {:g}{}{} in size", dimension_name(dimension), m.least, m.most,
                       dimension == Dimension::none ? "" : " ", si_unit(dimension)));
  }
  if (problem != std::errc{} || stop != end) {
    const Quantity q = parse_quantity(text, dimension);
    if (!q.si) refuse(dimension == Dimension::none ? "a number is expected" : q.problem);
    part = {q.si.value(), true};
  }
  if (const std::string size = magnitude_problem(part.si, dimension); !size.empty()) refuse(size);
  return part;
}

/// ln of a quantity's model is young ln E + shape(nu, plane) (+ terms in the density); of nu, nu itself.
struct Model {
  double young = 0.0, shape = 0.0, slope = 0.0;  ///< d(ln or nu)/d(ln E), value at E = 1, derivative by nu
};

Model model_of(TargetKind q, double nu, Plane plane) {
  switch (q) {
    case TargetKind::young:
      return {1.0, 0.0, 0.0};
    case TargetKind::poisson:
      return {0.0, nu, 1.0};
    case TargetKind::bar:
      return {0.5, 0.0, 0.0};
    case TargetKind::shear:
      return {0.5, -0.5 * std::log(2.0 * (1.0 + nu)), -0.5 / (1.0 + nu)};
    case TargetKind::p:
      break;
  }
  if (plane == Plane::stress) return {0.5, -0.5 * std::log(1.0 - nu * nu), nu / (1.0 - nu * nu)};
  return {0.5, 0.5 * std::log((1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu))),
          0.5 * (-1.0 / (1.0 - nu) - 1.0 / (1.0 + nu) + 2.0 / (1.0 - 2.0 * nu))};
}

/// One wanted value as an equation young ln E + shape(nu) = value, in units of its uncertainty.
struct Equation {
  TargetKind quantity;
  double value = 0.0, sigma = 0.0, known_sigma = 0.0;
};

std::vector<Equation> equations_of(const WantedValues& wanted) {
  std::vector<Equation> equations;
  for (const TargetKind q : kTargetKinds) {
    const auto& given = wanted.of(q);
    if (!given) continue;
    if (q == TargetKind::poisson) {
      equations.push_back(
          {q, given->value, given->stddev > 0.0 ? given->stddev : kAssumedUncertainty, given->stddev});
      continue;
    }
    const double known = given->stddev / given->value;
    const double density = q == TargetKind::young ? 0.0 : 0.5 * std::log(wanted.density.value());
    equations.push_back(
        {q, std::log(given->value) + density, known > 0.0 ? known : kAssumedUncertainty, known});
  }
  return equations;
}

double upper_poisson(Plane plane) {
  return plane == Plane::stress ? 1.0 : 0.5;
}

/// The best E for a nu, and the sum of squared deviations that it leaves.
struct Fit {
  double log_young = 0.0, nu = 0.0, cost = HUGE_VAL;
};

Fit best_young(const std::vector<Equation>& equations, double nu, Plane plane) {
  double weight = 0.0, sum = 0.0;
  for (const Equation& e : equations) {
    const Model m = model_of(e.quantity, nu, plane);
    weight += m.young * m.young / (e.sigma * e.sigma);
    sum += m.young * (e.value - m.shape) / (e.sigma * e.sigma);
  }
  Fit fit{sum / weight, nu, 0.0};
  for (const Equation& e : equations) {
    const Model m = model_of(e.quantity, nu, plane);
    fit.cost += std::pow((m.young * fit.log_young + m.shape - e.value) / e.sigma, 2);
  }
  return fit;
}

/// Rows: d(model)/d(ln E, nu) in units of the uncertainty; and what is missing to the value.
struct Linearised {
  Eigen::MatrixXd jacobian;
  Eigen::VectorXd deviation;
};

Linearised linearise(const std::vector<Equation>& equations, const Fit& at, Plane plane) {
  const auto rows = static_cast<Eigen::Index>(equations.size());
  Linearised l{Eigen::MatrixXd(rows, 2), Eigen::VectorXd(rows)};
  for (Eigen::Index r = 0; r < rows; ++r) {
    const Equation& e = equations[r];
    const Model m = model_of(e.quantity, at.nu, plane);
    l.jacobian.row(r) << m.young / e.sigma, m.slope / e.sigma;
    l.deviation[r] = (e.value - m.young * at.log_young - m.shape) / e.sigma;
  }
  return l;
}

/// Global by a grid in nu, on which E is eliminated (from high to low, so that of two signs the positive one
/// is found first), then Gauss-Newton.
Fit fit_solid(const std::vector<Equation>& equations, Plane plane) {
  const double upper = upper_poisson(plane);
  Fit best;
  constexpr int kGrid = 3000;
  for (int k = 1; k < kGrid; ++k) {
    const Fit fit = best_young(equations, upper - (upper + 1.0) * k / kGrid, plane);
    if (fit.cost < best.cost * (1.0 - 1e-9)) best = fit;
  }
  for (int n = 0; n < 50; ++n) {
    const Linearised l = linearise(equations, best, plane);
    const Eigen::Vector2d step = least_squares(l.jacobian, l.deviation);
    double nu = best.nu + step[1];
    if (!(nu > -1.0 && nu < upper)) nu = 0.5 * (best.nu + (nu >= upper ? upper : -1.0));
    const double change = std::abs(nu - best.nu);
    best = best_young(equations, nu, plane);
    if (change < 1e-15) break;
  }
  return best;
}

std::string values_text(const WantedValues& wanted) {
  std::string text;
  for (const TargetKind q : kTargetKinds) {
    if (wanted.of(q))
      text += fmt::format("{}{} {:.6g}{}{}", text.empty() ? "" : ", ", name(q), wanted.of(q)->value,
                          dimension_of(q) == Dimension::none ? "" : " ", si_unit(dimension_of(q)));
  }
  return text;
}

void require_agreement(const std::vector<Equation>& equations, const Fit& fit, const WantedValues& wanted) {
  const Linearised l = linearise(equations, fit, wanted.plane);
  const double worst = l.deviation.cwiseAbs().maxCoeff();
  // Two values either meet or miss; round-off of the logarithms is 1e-13 of the assumed uncertainty.
  const double allowed = equations.size() == 2 ? 1e-6 : kAgreement;
  if (worst <= allowed) return;
  throw InputError(fmt::format(
      "{}: these contradict each other: no isotropic solid with -1 < nu < {} has them all ({}; the nearest "
      "has E = {:.6g} Pa, nu = {:.4f})",
      values_text(wanted), upper_poisson(wanted.plane),
      wanted.plane == Plane::stress ? "plane stress" : "plane strain", std::exp(fit.log_young), fit.nu));
}

void require_possible(const WantedValues& wanted) {
  std::vector<std::string> problems;
  std::size_t given = 0, velocities = 0;
  for (const TargetKind q : kTargetKinds) {
    const auto& v = wanted.of(q);
    if (!v) continue;
    ++given;
    velocities += q >= TargetKind::bar ? 1 : 0;
    const double upper = upper_poisson(wanted.plane);
    if (q == TargetKind::poisson && !(v->value > -1.0 && v->value < upper)) {
      problems.push_back(
          fmt::format("Poisson's ratio {}: must lie between -1 and {} in {}", v->value, upper,
                      wanted.plane == Plane::stress ? "the plane (plane stress)" : "a solid (plane strain)"));
    } else if (q != TargetKind::poisson && !(v->value > 0.0 && std::isfinite(v->value))) {
      const Dimension dimension = dimension_of(q);
      problems.push_back(fmt::format("{} {} {}: must be positive and finite, at most {:g}; write {}", name(q), v->value, si_unit(dimension),
                                     magnitude_of(dimension).most, quantity_examples(dimension)));
    }
    if (!(v->stddev >= 0.0) || !std::isfinite(v->stddev)) {
      problems.push_back(
          fmt::format("{} +- {}: an uncertainty must be finite and not negative", name(q), v->stddev));
    }
  }
  if (given < 2)
    problems.push_back(
        "give two targets: --young and --poisson, or two of them and --bar-velocity, --shear-velocity, "
        "--p-velocity");
  if (velocities > 0 && !wanted.density)
    problems.push_back("velocities need --density, the bulk density of the material");
  if (wanted.density && !(*wanted.density > 0.0 && std::isfinite(*wanted.density))) {
    problems.push_back(fmt::format("density {}: must be positive and finite", *wanted.density));
  }
  if (wanted.of(TargetKind::young) && wanted.of(TargetKind::bar) && given == 2) {
    problems.push_back(
        "Young's modulus and bar velocity say the same; give Poisson's ratio or another velocity, too");
  }
  if (!problems.empty()) throw InputError(problems);
}

/// Covariance of (ln E, nu): that of the known uncertainties through the least squares.
Eigen::Matrix2d covariance_of(const std::vector<Equation>& equations, const Fit& fit, Plane plane) {
  const Linearised l = linearise(equations, fit, plane);
  Eigen::VectorXd known(l.deviation.size());
  for (Eigen::Index r = 0; r < known.size(); ++r) known[r] = equations[r].known_sigma / equations[r].sigma;
  const Eigen::MatrixXd gain = least_squares(l.jacobian, known.asDiagonal());
  return gain * gain.transpose();
}

}  // namespace

std::string_view name(TargetKind quantity) {
  constexpr std::array<std::string_view, kTargetKinds.size()> names = {
      "Young's modulus", "Poisson's ratio", "bar velocity", "shear velocity", "P velocity"};
  return names[static_cast<std::size_t>(quantity)];
}

Dimension dimension_of(TargetKind quantity) {
  if (quantity == TargetKind::young) return Dimension::stress;
  return quantity == TargetKind::poisson ? Dimension::none : Dimension::velocity;
}

Uncertain parse_uncertain(std::string_view option, std::string_view text, Dimension dimension) {
  for (const std::string_view sign : {std::string_view("+-"), std::string_view("\u00B1")}) {
    const auto at = text.find(sign);
    if (at == std::string_view::npos) continue;
    const Part value = parse_part(option, text, text.substr(0, at), dimension);
    const Part stddev = parse_part(option, text, text.substr(at + sign.size()), dimension);
    if (value.has_unit != stddev.has_unit) {
      throw InputError(
          fmt::format("{} {}: give both the value and its uncertainty a unit, or neither", option, text));
    }
    return {value.si, stddev.si};
  }
  return {parse_part(option, text, text, dimension).si, 0.0};
}

Target make_target(const WantedValues& wanted) {
  require_possible(wanted);
  const std::vector<Equation> equations = equations_of(wanted);
  const Fit fit = fit_solid(equations, wanted.plane);
  require_agreement(equations, fit, wanted);
  Target t;
  const bool both = equations.size() == 2 && wanted.of(TargetKind::young) && wanted.of(TargetKind::poisson);
  t.solid_young_modulus = both ? wanted.of(TargetKind::young)->value : std::exp(fit.log_young);
  t.solid_poisson_ratio = both ? wanted.of(TargetKind::poisson)->value : fit.nu;
  t.young_modulus = t.solid_young_modulus;
  t.poisson_ratio = t.solid_poisson_ratio;
  t.covariance = covariance_of(equations, fit, wanted.plane);
  t.density = wanted.density;
  t.conversion = "plane stress: E and nu as they are";
  if (wanted.plane == Plane::strain) {
    const double nu = t.solid_poisson_ratio;
    const auto plane = references::plane_strain_constants(t.solid_young_modulus, nu);
    t.young_modulus = plane.young_modulus;
    t.poisson_ratio = plane.poisson_ratio;
    Eigen::Matrix2d map;
    map << 1.0, 2.0 * nu / (1.0 - nu * nu), 0.0, 1.0 / ((1.0 - nu) * (1.0 - nu));
    t.covariance = (map * t.covariance * map.transpose()).eval();
    t.conversion = fmt::format(
        "plane strain: E = {:.8g} Pa, nu = {:.8g} of the solid become E/(1 - nu^2) = {:.8g} Pa, nu/(1 - nu) "
        "= {:.8g} of the plane",
        t.solid_young_modulus, nu, t.young_modulus, t.poisson_ratio);
  }
  return t;
}

}  // namespace ddem::harness
