#include "harness/references/effective_moduli.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "harness/references/require_positive.h"

namespace ddem::references {
namespace {

/// 2G of the DDEM variants; g_p = 4 phi 2G_p.
double twice_shear(ContactModel model, double A, double lambda, double g_p) {
  switch (model) {
    case ContactModel::dem:
      break;
    case ContactModel::ddem_normal:
      return A * (1.0 + lambda) / 4.0 / (1.0 + A / g_p);
    case ContactModel::ddem_full:
      return A * (1.0 + lambda) / 4.0 / (1.0 + A * (1.0 + lambda) / g_p);
    case ContactModel::ddem_normal_only_stress:
      return A / 4.0 / (1.0 + A / g_p) + A * lambda / 4.0;
  }
  throw std::invalid_argument("no deformable particles in this contact model");
}

}  // namespace

Fabric hexagonal_fabric() {
  return {2.0 * std::numbers::sqrt3, std::numbers::pi / (2.0 * std::numbers::sqrt3)};
}

Fabric random_fabric(std::span<const double> bond_lengths, std::span<const double> radii, double area) {
  require_positive(area, "area of the assembly");
  Fabric fabric;
  for (double length : bond_lengths) fabric.length_squares_per_area += length * length / area;
  for (double radius : radii) fabric.solid_fraction += std::numbers::pi * radius * radius / area;
  require_positive(fabric.length_squares_per_area, "sum of squared bond lengths");
  require_positive(fabric.solid_fraction, "solid fraction");
  return fabric;
}

PlaneModuli effective_moduli(ContactModel model, const Fabric& fabric, const Contact& contact,
                             const Disc& disc) {
  require_positive(contact.normal_stiffness, "normal stiffness");
  require_positive(disc.thickness, "thickness");
  require_positive(fabric.length_squares_per_area, "sum of squared bond lengths");
  require_positive(fabric.solid_fraction, "solid fraction");
  const double lambda = contact.stiffness_ratio;
  if (!(lambda >= 0.0) || !std::isfinite(lambda))
    throw std::invalid_argument(
        fmt::format("the stiffness ratio must be finite and not negative, not {}", lambda));

  const double A = fabric.length_squares_per_area * contact.normal_stiffness / disc.thickness;
  if (model == ContactModel::dem) return {A / 4.0, A * (1.0 + lambda) / 8.0};
  const PlaneModuli particle = plane_moduli(disc.material);
  const double k_p = 2.0 * fabric.solid_fraction * 2.0 * particle.bulk;
  const double g_p = 4.0 * fabric.solid_fraction * 2.0 * particle.shear;
  return {A / 4.0 / (1.0 + A / k_p), 0.5 * twice_shear(model, A, lambda, g_p)};
}

double chain_stiffness(double normal_stiffness, double young_modulus, double thickness) {
  require_positive(normal_stiffness, "normal stiffness");
  require_positive(young_modulus, "Young's modulus");
  require_positive(thickness, "thickness");
  return normal_stiffness / (1.0 + 4.0 * normal_stiffness / (std::numbers::pi * young_modulus * thickness));
}

}  // namespace ddem::references
