#include "harness/campaign/strip_statics.h"

#include <fmt/format.h>

#include "dem/spectra/spectra.h"
#include "harness/model/assemble.h"
#include "harness/run/section_speeds.h"

namespace ddem::harness {

std::vector<StripMaterial> materials_of(const StripCampaign& s) {
  std::vector<StripMaterial> keys;
  for (const Model model : s.models) {
    for (const double ratio : s.stiffness_ratios) {
      keys.push_back({StripPacking::hexagonal, 0, model, ratio});
      for (const std::int64_t seed : s.seeds) keys.push_back({StripPacking::random, seed, model, ratio});
    }
  }
  return keys;
}

StripCase case_of(const StripMaterial& m, StripWave wave, Protocol protocol) {
  return {m.packing, m.seed, m.model, m.stiffness_ratio, protocol, wave};
}

std::vector<StripCase> cases_of(const StripMaterial& m) {
  std::vector<StripCase> cases;
  for (const StripWave wave : {StripWave::bar, StripWave::shear, StripWave::p}) {
    cases.push_back(case_of(m, wave));
    if (m.packing == StripPacking::random && wave != StripWave::p)
      cases.push_back(case_of(m, wave, Protocol::paper));
  }
  return cases;
}

const ddem::Assembly& StripStatics::strip(StripPacking packing, std::int64_t seed, bool periodic) {
  return strips_.get(fmt::format("{} {} {}", static_cast<int>(packing), seed, periodic), [&] {
    const StripCase c{
        packing, seed, Model::dem, 0.0, Protocol::long_wave, periodic ? StripWave::p : StripWave::bar};
    return build_assembly(scene_of(assembly_text(campaign_, c, false), "strip"));
  });
}

/// P and shear waves share their strip.
Speeds StripStatics::section_speeds_of(const StripMaterial& key) {
  const auto between = [&](StripWave wave) {
    const Scene scene = scene_of(scene_text(campaign_, case_of(key, wave), 1.0), "sections");
    const ddem::Assembly& a = strip(key.packing, key.seed, wave != StripWave::bar);
    return section_speeds(scene, a, lay_probes(scene, a));
  };
  const auto free = between(StripWave::bar), periodic = between(StripWave::p);
  return {free.bar, periodic.s, periodic.p};
}

StaticOutcome StripStatics::solve(const StripMaterial& key) {
  StaticOutcome out;
  out.key = key;
  try {
    const Scene scene = scene_of(assembly_text(campaign_, case_of(key, StripWave::bar), false), "statics");
    const ddem::Assembly& closed = strip(key.packing, key.seed, true);
    out.moduli = scene_moduli(scene, strip(key.packing, key.seed, false), &closed);
    const DirectionalSpeeds speeds = out.moduli.speeds().value();
    out.speeds = {speeds.bar, speeds.s, speeds.p};
    out.critical_time_step = 2.0 / largest_frequency(closed, contact_parameters(scene), {});
    // A lattice's cell has all its bonds; a strip's ends have not.
    if (key.packing == StripPacking::hexagonal) {
      StripCampaign small = campaign_;
      small.columns = small.rows = 8;
      Scene cell = scene_of(assembly_text(small, case_of(key, StripWave::p), true), "cell");
      out.kinematic = kinematic_moduli(cell, build_assembly(cell));
      if (options_.disturb_scene) options_.disturb_scene(cell);
      out.cell = scene_moduli(cell).isotropic();
    } else {
      out.kinematic = kinematic_moduli(scene, closed);
      out.sections = section_speeds_of(key);
    }
    const auto k = references::bulk_wave_speeds(out.kinematic, out.moduli.bulk_density);
    out.kinematic_speeds = {k.bar, k.shear, k.p};
  } catch (const std::exception& e) {
    out.failure = e.what();
  }
  return out;
}

StaticOutcome StripStatics::of(const StripMaterial& material) {
  StripMaterial solved = material;
  solved.model = continuum_model(campaign_, material.model);
  StaticOutcome out = solved_.get(id_of(case_of(solved, StripWave::bar)), [&] { return solve(solved); });
  out.key = material;
  return out;
}

}  // namespace ddem::harness
