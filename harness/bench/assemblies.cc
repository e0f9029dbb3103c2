#include "harness/bench/assemblies.h"

#include <cmath>
#include <numbers>

#include "dem/assembly/contacts.h"
#include "meshes/packings/hexagonal.h"

namespace ddem::harness::bench {
namespace {

constexpr double kAmplitude = 1e-9;  // m; the laws here are linear

ContactParameters contact(bool shear, bool per_bond) {
  ContactParameters c;
  c.normal_stiffness = kNormalStiffness;
  c.stiffness_ratio = shear ? kShearRatio : 0.0;
  if (per_bond) c.contact_modulus = kNormalStiffness / kRadius;  // k_n = E_c r of equal discs (bond_stiffness.h)
  return c;
}

}  // namespace

Law rigid(bool shear, bool per_bond) {
  return {shear ? "DEM" : "DEM, k_t = 0", contact(shear, per_bond), {}};
}

Law deformable(Scheme scheme, bool shear, bool per_bond) {
  const std::string name = scheme == Scheme::lagged ? "lagged" : "implicit";
  Law law{shear ? name : name + ", k_t = 0", contact(shear, per_bond), {}};
  law.deformation.scheme = scheme;
  law.deformation.correction = Correction::full;
  law.deformation.young_modulus = kNormalStiffness / kSoftness;
  law.deformation.poisson_ratio = kDiscPoisson;
  return law;
}

ddem::Assembly lattice(int columns, int rows, bool periodic, double radius) {
  const Packing p = packings::hexagonal(
      {.columns = columns, .rows = rows, .radius = radius, .periodic_x = periodic, .periodic_y = periodic});
  return make_assembly(p, bonds_within_gap(p, 0.1 * radius), 1.0, kDensity);
}

std::array<int, 2> lattice_size(std::size_t discs) {
  if (discs == 682) return {62, 11};  // the strip of the paper
  const int rows = std::max(2, 2 * static_cast<int>(std::lround(0.5 * std::sqrt(static_cast<double>(discs) / 5.0))));
  return {static_cast<int>(std::lround(static_cast<double>(discs) / rows)), rows};
}

double lattice_step(double fraction) {
  const double mass = kDensity * std::numbers::pi * kRadius * kRadius;
  return fraction * 2.0 / std::sqrt(6.0) * std::sqrt(mass / kNormalStiffness);
}

ddem::InitialState smooth_state(const ddem::Assembly& a) {
  ddem::InitialState state;
  const double k = std::numbers::pi / a.packing.length;
  for (std::size_t d = 0; d < a.size(); ++d) {
    state.ux.push_back(kAmplitude * std::cos(k * a.packing.x[d]));
    state.uy.push_back(kAmplitude * std::sin(k * (a.packing.x[d] + 0.3 * a.packing.y[d])));
    state.theta.push_back(kAmplitude / kRadius * std::sin(k * a.packing.y[d]));
  }
  return state;
}

}  // namespace ddem::harness::bench
