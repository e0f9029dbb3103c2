#include "harness/studies/strip/strip_statics.h"

#include <fmt/format.h>

#include <chrono>

#include "dem/spectra/spectra.h"
#include "dem/spectra/strain_polynomial.h"
#include "harness/model/assemble.h"
#include "harness/run/section_speeds.h"

namespace ddem::harness {

const ddem::Assembly& StripStatics::strip(StripPacking packing, std::int64_t seed, bool periodic) {
  return strips_.get(fmt::format("{} {} {}", static_cast<int>(packing), seed, periodic), [&] {
    const StripCase c{
        packing, seed, Model::dem, 0.0, Protocol::long_wave, periodic ? StripWave::p : StripWave::bar};
    return build_assembly(scene_of(assembly_text(campaign_, c, false), "strip"));
  });
}

std::vector<double> StripStatics::relaxations(const StripMaterial& m, bool periodic) {
  if (m.model != Model::implicit_full) return {};
  return relaxations_.get(fmt::format("{} {}", id_of(case_of(m, StripWave::bar)), periodic), [&] {
    const Scene scene = scene_of(assembly_text(campaign_, case_of(m, StripWave::bar), false), "strains");
    return strain_relaxations(strip(m.packing, m.seed, periodic), contact_parameters(scene), deformation_parameters(scene));
  });
}

double StripStatics::critical_time_step_of(const StripMaterial& m) {
  const StripCase rigid = case_of({m.packing, m.seed, Model::dem, m.stiffness_ratio}, StripWave::p);
  return critical_time_steps_.get(id_of(rigid), [&] {
    const Scene scene = scene_of(assembly_text(campaign_, rigid, false), "critical step");
    return 2.0 / largest_frequency(strip(m.packing, m.seed, true), contact_parameters(scene), {});
  });
}

/// Where the long waves' probes look.
Speeds StripStatics::section_speeds_of(const StripMaterial& key, const GrippedStrip& free, const GrippedStrip& closed) {
  const auto between = [&](StripWave wave, const GrippedStrip& strip) {
    const Scene scene = scene_of(scene_text(campaign_, case_of(key, wave), 1.0), "sections");
    return section_speeds(strip, lay_probes(scene, strip.assembly()));
  };
  const auto open = between(StripWave::bar, free), periodic = between(StripWave::p, closed);
  return {open.bar, periodic.s, periodic.p};
}

/// A lattice's cell has all its bonds; a strip's ends have not.
void StripStatics::solve_cell(StaticOutcome& out) {
  StripCampaign small = campaign_;
  small.columns = small.rows = 8;
  Scene cell = scene_of(assembly_text(small, case_of(out.key, StripWave::p), true), "cell");
  out.kinematic = kinematic_moduli(cell, build_assembly(cell));
  if (options_.disturb_scene) options_.disturb_scene(cell);
  out.cell = scene_moduli(cell).isotropic();
  const ddem::Assembly discs = build_assembly(cell);
  out.bloch = bloch_limit({discs.packing.radius.front(), discs.density, discs.thickness}, contact_parameters(cell),
                          deformation_parameters(cell));
}

StaticOutcome StripStatics::solve(const StripMaterial& key) {
  StaticOutcome out;
  out.key = key;
  try {
    const Scene scene = scene_of(assembly_text(campaign_, case_of(key, StripWave::bar), false), "statics");
    const ddem::Assembly &closed = strip(key.packing, key.seed, true), &free = strip(key.packing, key.seed, false);
    const auto start = std::chrono::steady_clock::now();
    const GrippedStrip free_strip = gripped(scene, free), closed_strip = gripped(scene, closed);
    out.moduli = scene_moduli(free_strip, closed_strip);
    out.solve_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const DirectionalSpeeds speeds = out.moduli.speeds().value();
    out.speeds = {speeds.bar, speeds.s, speeds.p};
    out.critical_time_step = critical_time_step_of(key);
    if (key.packing == StripPacking::hexagonal) {
      solve_cell(out);
    } else {
      out.kinematic = kinematic_moduli(scene, closed);
      out.sections = section_speeds_of(key, free_strip, closed_strip);
    }
    const auto k = references::bulk_wave_speeds(out.kinematic, out.moduli.moving_density);
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
