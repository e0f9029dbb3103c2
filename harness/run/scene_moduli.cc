#include "harness/run/scene_moduli.h"

#include <cmath>
#include <stdexcept>

#include "dem/assembly/bond_stiffness.h"
#include "dem/assembly/contacts.h"
#include "harness/io/errors.h"
#include "harness/model/assemble.h"
#include "harness/model/memory_need.h"
#include "harness/references/effective_moduli.h"

namespace ddem::harness {
namespace {

references::ContactModel contact_model(const DeformationParameters& d) {
  if (!d.active()) return references::ContactModel::dem;
  switch (d.correction) {
    case Correction::normal: return references::ContactModel::ddem_normal;
    case Correction::full: return references::ContactModel::ddem_full;
    case Correction::normal_only_stress: return references::ContactModel::ddem_normal_only_stress;
  }
  return references::ContactModel::dem;
}

/// Of bonds of different stiffness, the one that gives the same sum k_n L^2: what a uniform strain feels.
double stiffness_under_strain(const ddem::Assembly& a, const ContactParameters& contact) {
  if (contact.uniform()) return contact.normal_stiffness;
  const std::vector<double> k_n = normal_stiffnesses(a, contact);
  double weighted = 0.0, weight = 0.0;
  for (std::size_t c = 0; c < k_n.size(); ++c) {
    const double square = a.bonds.length[c] * a.bonds.length[c];
    weighted += k_n[c] * square;
    weight += square;
  }
  return weighted / weight;
}

SceneModuli description_of(const ddem::Assembly& a) {
  SceneModuli m;
  m.discs = static_cast<int>(a.size());
  m.bonds = static_cast<int>(a.bonds.size());
  m.rattlers = static_cast<int>(a.rattlers.size());
  m.coordination = coordination(a.bonds, a.size());
  m.solid_fraction = solid_fraction(a);
  m.bulk_density = bulk_density(a);
  m.moving_density = moving_density(a);
  return m;
}

SceneModuli moduli_of_cell(const Scene& scene, const ddem::Assembly& a) {
  SceneModuli m = description_of(a);
  m.method = "homogenisation of the cell periodic in x and y";
  m.stiffness = homogenise_cell(a, contact_parameters(scene), deformation_parameters(scene));
  return m;
}

SceneModuli moduli_between_periodic_edges(const GrippedStrip& strip) {
  SceneModuli m = description_of(strip.assembly());
  m.method = "homogenisation periodic in y, between inner sections along x";
  m.stiffness = strip.stiffness();
  return m;
}

/// `closed`: null where the packing does not close, `missing` why.
SceneModuli moduli_between_free_edges(const GrippedStrip& strip, const GrippedStrip* closed, const std::string& missing) {
  SceneModuli m = description_of(strip.assembly());
  m.strip = strip.tension();
  if (closed == nullptr) {
    m.method = "the free strip under tension only: " + missing;
    return m;
  }
  m.stiffness = closed->stiffness();
  m.moving_density = moving_density(closed->assembly());
  m.method = "the packing closed in y (between flat walls: its periodic counterpart of the same seed), homogenised; bar speed from the free strip under tension";
  return m;
}

}  // namespace

std::optional<IsotropicModuli> SceneModuli::isotropic() const {
  if (!stiffness) return std::nullopt;
  return isotropic_part(*stiffness);
}

std::optional<DirectionalSpeeds> SceneModuli::speeds() const {
  if (!stiffness) return std::nullopt;
  DirectionalSpeeds s = directional_speeds(*stiffness, moving_density);
  if (strip) s.bar = strip->bar_velocity();
  return s;
}

std::optional<double> SceneModuli::speed_of(Wave wave, bool periodic) const {
  const bool bar = wave == Wave::longitudinal && !periodic;
  if (bar && strip) return strip->bar_velocity();
  const auto s = speeds();
  if (!s) return std::nullopt;
  return wave == Wave::shear ? s->s : periodic ? s->p : s->bar;
}

GrippedStrip gripped(const Scene& scene, const ddem::Assembly& a) {
  return {a, contact_parameters(scene), deformation_parameters(scene), edge_band(scene, a)};
}

SceneModuli scene_moduli(const GrippedStrip& strip, const GrippedStrip& closed) { return moduli_between_free_edges(strip, &closed, ""); }

namespace {

/// Stiffnesses that are too far apart leave round-off alone.
SceneModuli finite(SceneModuli m) {
  const auto speeds = m.speeds();  // of a stiffness below 0 there are none
  const bool good = (!speeds || std::isfinite(speeds->p + speeds->s)) && (!m.strip || std::isfinite(m.strip->bar_velocity()));
  if (!good) throw std::runtime_error("no stiffness is left, or stiffnesses are too far apart for the numbers of a computer");
  return m;
}

}  // namespace

SceneModuli scene_moduli(const Scene& scene) {
  require_memory_of_discs(scene, DiscWork::statics);
  const ddem::Assembly a = build_network(scene);
  const LaterallyClosed closed = scene.assembly.periodic.y ? LaterallyClosed{} : build_laterally_closed(scene);
  try {
    if (scene.assembly.periodic.x && scene.assembly.periodic.y) return finite(moduli_of_cell(scene, a));
    const GrippedStrip strip = gripped(scene, a);
    if (scene.assembly.periodic.y) return finite(moduli_between_periodic_edges(strip));
    const auto closed_strip = closed.assembly ? std::optional(gripped(scene, *closed.assembly)) : std::nullopt;
    return finite(moduli_between_free_edges(strip, closed_strip ? &*closed_strip : nullptr, closed.missing));
  } catch (const std::invalid_argument& e) {
    throw InputError(scene.path.string() + ": [assembly]: " + e.what());
  } catch (const std::runtime_error& e) {
    throw SolverError(std::string("static moduli: ") + e.what());
  }
}

references::PlaneModuli kinematic_moduli(const Scene& scene, const ddem::Assembly& a) {
  const ContactParameters contact = contact_parameters(scene);
  const DeformationParameters deformation = deformation_parameters(scene);
  references::Disc disc;
  disc.thickness = a.thickness;
  if (deformation.active()) {
    disc.material = deformation.plane == Plane::strain
                        ? references::plane_strain_constants(deformation.young_modulus, deformation.poisson_ratio)
                        : references::PlaneConstants{deformation.young_modulus, deformation.poisson_ratio};
  }
  std::vector<double> radii;
  for (const int d : network_discs(a)) radii.push_back(a.packing.radius[d]);
  references::Fabric fabric = references::random_fabric(a.bonds.length, radii, a.area());
  if (deformation.volume == ParticleVolume::cell) fabric.solid_fraction = 1.0;  // the cells fill the assembly
  return references::effective_moduli(contact_model(deformation), fabric, {stiffness_under_strain(a, contact), contact.stiffness_ratio},
                                      disc);
}

double kinematic_speed(const Scene& scene, const ddem::Assembly& a, Wave wave) {
  const auto speeds = references::bulk_wave_speeds(kinematic_moduli(scene, a), moving_density(a));
  if (wave == Wave::shear) return speeds.shear;
  return scene.assembly.periodic.y ? speeds.p : speeds.bar;
}

}  // namespace ddem::harness
