#include "harness/studies/calibration/design.h"

#include <fmt/format.h>

#include "harness/studies/strip/whole.h"

#include "dem/statics/moduli.h"
#include "harness/model/assemble.h"
#include "harness/references/effective_moduli.h"

namespace ddem::harness {
namespace {

DesignPoint lattice_point(double stiffness_ratio, double softness, double nu_p) {
  const auto c = references::plane_constants(
      references::effective_moduli(references::ContactModel::ddem_full, references::hexagonal_fabric(),
                                   {1.0, stiffness_ratio}, {{1.0 / softness, nu_p}, 1.0}));
  return {c.young_modulus, c.poisson_ratio};
}

}  // namespace

void require_whole(const DesignStudy& found) {
  GroupNames names;
  for (const SoftnessCurve& c : found.curves) {
    names.add(fmt::format("{:g}", c.particle_poisson_ratio));
    require_length("a curve", c.random.size(), found.softness.size());
    require_length("a curve of the lattice", c.lattice.size(), found.softness.size());
  }
}

DesignStudy study_design(const StripCampaign& s) {
  DesignStudy study;
  study.stiffness_ratio = 0.2;  // that of the soft discs which are calibrated
  study.softness = {0.01, 0.03, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0};
  const StripCase c{StripPacking::random,  s.seeds.front(),     Model::dem,
                    study.stiffness_ratio, Protocol::long_wave, StripWave::p};
  const Scene scene = scene_of(assembly_text(s, c, false), "design curves");
  const ddem::Assembly a = build_assembly(scene);
  ContactParameters contact;
  contact.normal_stiffness = 1.0;
  contact.stiffness_ratio = study.stiffness_ratio;
  for (const double nu_p : {0.0, 0.3, 0.49}) {
    SoftnessCurve curve{nu_p, {}, {}};
    for (const double softness : study.softness) {
      DeformationParameters discs;
      discs.scheme = Scheme::implicit;
      discs.correction = Correction::full;
      discs.young_modulus = 1.0 / softness;
      discs.poisson_ratio = nu_p;
      const IsotropicModuli m = isotropic_part(homogenise_strip(a, contact, discs, edge_band(scene, a)));
      curve.random.push_back({m.young(), m.poisson()});
      curve.lattice.push_back(lattice_point(study.stiffness_ratio, softness, nu_p));
    }
    study.curves.push_back(curve);
  }
  return study;
}

}  // namespace ddem::harness
