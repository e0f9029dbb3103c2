#pragma once
// What a calibration aims at: plane moduli, from moduli or wave speeds with their uncertainties.

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "dem/core/material.h"
#include "harness/measure/elastic_constants.h"
#include "harness/scene/units.h"

namespace ddem::harness {

enum class TargetKind { young, poisson, bar, shear, p };
inline constexpr std::array kTargetKinds = {TargetKind::young, TargetKind::poisson, TargetKind::bar,
                                            TargetKind::shear, TargetKind::p};

/// "Young's modulus", "Poisson's ratio", "bar velocity", ...
std::string_view name(TargetKind quantity);
Dimension dimension_of(TargetKind quantity);

/// "30 GPa", "3e10", or with a standard uncertainty "30 GPa +- 1 GPa" ("±" will do); plain numbers are SI.
/// Both parts with a unit or both without. Throws InputError naming the option; does not judge the value.
Uncertain parse_uncertain(std::string_view option, std::string_view text, Dimension dimension);

/// Values of the solid: two of them or more. A standard deviation of 0 means that none is known.
struct WantedValues {
  std::array<std::optional<Uncertain>, kTargetKinds.size()> values;  ///< by TargetKind; Pa, 1, m/s
  std::optional<double> density;                                     ///< bulk, kg/m3; needed for velocities
  Plane plane = Plane::stress;

  std::optional<Uncertain>& of(TargetKind q) { return values[static_cast<std::size_t>(q)]; }
  const std::optional<Uncertain>& of(TargetKind q) const { return values[static_cast<std::size_t>(q)]; }
};

struct Target {
  double young_modulus = 0.0, poisson_ratio = 0.0;              ///< of the plane model
  double solid_young_modulus = 0.0, solid_poisson_ratio = 0.0;  ///< of the solid: the same in plane stress
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();         ///< of (ln E, nu) of the plane model
  std::optional<double> density;                                ///< bulk, kg/m3
  std::string conversion;                                       ///< what was done, in words
};

/// E and nu of the solid that fits the wanted values, exactly where there are two, by least squares of
/// relative deviations where there are more, and then in the plane: plane stress as they are, plane strain
/// E/(1 - nu^2), nu/(1 - nu). With density rho
///   bar = sqrt(E/rho),  shear = sqrt(E/(2 (1 + nu) rho)),  P = sqrt(E/((1 - nu^2) rho)), in plane strain
///   P = sqrt(E (1 - nu)/((1 + nu)(1 - 2 nu) rho)), a thin rod's bar and no other shear.
/// Bar and P velocity leave the sign of nu open: it is taken as positive. Throws InputError with every
/// problem: values that are not finite or not possible, fewer than two, velocities without a density, values
/// that contradict each other (by more than three of their uncertainties; 1 % where none is given).
Target make_target(const WantedValues& wanted);

}  // namespace ddem::harness
