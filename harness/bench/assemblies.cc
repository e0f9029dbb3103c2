#include "harness/bench/assemblies.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/assembly/contacts.h"
#include "harness/model/random_packing.h"
#include "meshes/packings/hexagonal.h"

namespace ddem::harness::bench {
namespace {

constexpr double kAmplitude = 1e-9;  // m; the laws here are linear
constexpr std::size_t kPaperDiscs = 682;
constexpr double kPaperLength = 16.5e-3, kPaperWidth = 2e-3;  // m
constexpr double kCoordination = 5.8;
constexpr double kAspect = 5.0;

ContactParameters contact(bool shear, bool per_bond) {
  ContactParameters c;
  c.normal_stiffness = kNormalStiffness;
  c.stiffness_ratio = shear ? kShearRatio : 0.0;
  if (per_bond) c.contact_modulus = kNormalStiffness / kRadius;  // k_n = E_c r of equal discs (bond_stiffness.h)
  return c;
}

double step_of_mass(double mass, double fraction) {
  return fraction * 2.0 / std::sqrt(6.0) * std::sqrt(mass / kNormalStiffness);
}

ddem::Assembly random_strip(std::size_t discs) {
  const auto [length, width] = random_size(discs);
  const RandomPacking spec{.length = length, .width = width, .discs = static_cast<std::int64_t>(discs)};
  const double gap = gap_for_coordination(jammed_cell(spec, {}), kCoordination);  // every gap of copies is there as often as they are
  Packing p = random_packing(spec, {});
  p.period = {};  // the edges of a strip
  return make_assembly(p, bonds_within_gap(p, gap), 1.0, kDensity);
}

}  // namespace

std::string name_of(Arrangement arrangement) {
  return arrangement == Arrangement::lattice ? "lattice" : "random";
}

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

ddem::Assembly strip_of(Arrangement arrangement, std::size_t discs) {
  if (arrangement == Arrangement::random) return random_strip(discs);
  const auto [columns, rows] = lattice_size(discs);
  return lattice(columns, rows);
}

std::array<int, 2> lattice_size(std::size_t discs) {
  if (discs == kPaperDiscs) return {62, 11};
  const int rows = std::max(2, 2 * static_cast<int>(std::lround(0.5 * std::sqrt(static_cast<double>(discs) / kAspect))));
  return {static_cast<int>(std::lround(static_cast<double>(discs) / rows)), rows};
}

std::array<double, 2> random_size(std::size_t discs) {
  const double part = static_cast<double>(discs) / kPaperDiscs, area = kPaperLength * kPaperWidth * part;
  const double width = discs == kPaperDiscs ? kPaperWidth : std::sqrt(area / kAspect);
  return {area / width, width};
}

double lattice_step(double fraction) {
  return step_of_mass(kDensity * std::numbers::pi * kRadius * kRadius, fraction);
}

double step_of(const ddem::Assembly& a, double fraction) {
  return step_of_mass(*std::min_element(a.mass.begin(), a.mass.end()), fraction);
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
