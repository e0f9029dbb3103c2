#include "harness/run/fem_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>

#include "harness/io/errors.h"
#include "harness/io/hdf5.h"
#include "harness/io/json.h"
#include "harness/io/own_files.h"
#include "harness/io/subprocess.h"
#include "harness/io/temporary_folder.h"
#include "harness/references/plane_elasticity.h"
#include "harness/run/fem_reuse.h"

namespace ddem::harness {
namespace {

Json load_json(const FemCase& c) {
  const auto wave_name = [](Wave w) { return w == Wave::longitudinal ? "longitudinal" : "shear"; };
  if (const auto* drive = std::get_if<Drive>(&c.load)) {
    return {{"wave", wave_name(drive->wave)}, {"shape", "sin2"}, {"duration", drive->duration}, {"amplitude", drive->amplitude}};
  }
  const InitialPulse& p = std::get<InitialPulse>(c.load);
  Json j{{"wave", wave_name(p.wave)}, {"amplitude", p.amplitude}};
  switch (p.shape) {
    case PulseShape::column:
      j["shape"] = "column";
      j["spacing"] = c.column_spacing;
      break;
    case PulseShape::cosine:
      j["shape"] = "cosine";
      j["width"] = p.width;
      break;
    case PulseShape::gaussian:
      j["shape"] = "gaussian";
      j["width"] = p.width;
      j["center"] = p.center;
      break;
  }
  return j;
}

const char* edge_name(Edge edge) {
  return edge == Edge::free ? "free" : edge == Edge::fixed_x ? "fixed_x" : "fixed";
}

Json case_json(const FemCase& c) {
  Json j{{"id", c.id},
         {"length", c.length},
         {"width", c.width},
         {"degree", c.degree},
         {"young_modulus", c.material.young_modulus},
         {"poisson_ratio", c.material.poisson_ratio},
         {"density", c.material.density},
         {"plane", "stress"},
         {"top_bottom", c.periodic ? "periodic" : "free"},
         {"right", edge_name(c.right)},
         {"left", edge_name(c.left)},
         {"time", {{"integrator", c.integrator == Integrator::exact ? "exact" : "verlet"}, {"end", c.end}}},
         {"receivers", {{"points", c.points}, {"sections", c.sections}}},
         {"sample_every", c.sample_every}};
  if (c.snapshots > 0) j["snapshots"] = c.snapshots;
  if (c.mesh.empty()) {
    j["elements"] = c.elements;
  } else {
    j["mesh"] = c.mesh;
  }
  if (const auto* seconds = std::get_if<StepSeconds>(&c.step)) {
    j["time"]["step"] = seconds->seconds;
  } else {
    j["time"]["step_fraction"] = std::get<StepFraction>(c.step).of_critical;
  }
  j[std::holds_alternative<Drive>(c.load) ? "drive" : "initial"] = load_json(c);
  return j;
}

std::string fem_program() {
  const std::filesystem::path program = program_folder() / "ddem-fem";
  if (!std::filesystem::exists(program)) {
    throw MachineError(program.string() + " is missing: the finite-element reference was not built (it needs deal.II, "
                                          "Debian package libdeal.ii-dev)");
  }
  return program.string();
}

/// time x receiver x (ux, uy), split into signals.
void split(const Hdf5Array<double>& data, std::vector<std::vector<double>>& ux, std::vector<std::vector<double>>& uy) {
  const std::size_t times = data.shape.at(0), receivers = data.shape.at(1);
  ux.assign(receivers, std::vector<double>(times));
  uy = ux;
  for (std::size_t n = 0; n < times; ++n) {
    for (std::size_t r = 0; r < receivers; ++r) {
      ux[r][n] = data.values[(n * receivers + r) * 2];
      uy[r][n] = data.values[(n * receivers + r) * 2 + 1];
    }
  }
}

FemFields read_fields(const Hdf5Group& g) {
  FemFields f;
  f.x = g.read_doubles("x").values;
  f.y = g.read_doubles("y").values;
  f.quadrilaterals = g.read_ints("quadrilaterals").values;
  f.time = g.read_doubles("time").values;
  for (const NamedFemField& field : named_fem_fields) f.*field.values = g.read_doubles(field.name).values;
  return f;
}

FemResult read_result(const Hdf5Group& root, const FemCase& c) {
  const Hdf5Group g = root.group(c.id);
  FemResult r;
  r.id = c.id;
  r.status = g.string_attribute("status");
  r.degree = c.degree;
  r.elements = c.elements;
  if (!c.mesh.empty()) r.elements = {static_cast<int>(g.int_attribute("element_count")), 1};
  r.dofs = static_cast<long>(g.int_attribute("dofs"));
  r.steps = static_cast<long>(g.int_attribute("steps"));
  r.critical_time_step = g.double_attribute("critical_time_step");
  r.time_step = g.double_attribute("time_step");
  r.solve_seconds = g.double_attribute("solve_seconds");
  r.energy_drift = g.has_attribute("energy_drift") ? g.double_attribute("energy_drift") : std::nan("");
  r.sample_interval = g.double_attribute("sample_interval");
  r.time = g.read_doubles("time").values;
  if (!c.points.empty()) split(g.read_doubles("points"), r.point_ux, r.point_uy);
  if (!c.sections.empty()) split(g.read_doubles("sections"), r.section_ux, r.section_uy);
  if (g.contains("fields")) r.fields = read_fields(g.group("fields"));
  return r;
}

}  // namespace

double ContinuumMaterial::wave_speed(Wave wave, bool periodic) const {
  const double e = young_modulus / density, nu = poisson_ratio;
  if (wave == Wave::shear) return std::sqrt(e / (2.0 * (1.0 + nu)));
  return std::sqrt(periodic ? e / (1.0 - nu * nu) : e);
}

std::vector<FemResult> run_fem(std::span<const FemCase> cases, const std::function<void()>& on_case, std::int64_t threads) {
  if (cases.empty()) return {};
  const FemReuse reuse = share_runs(cases);
  // Runs are named by their number; a caller's names need not be those of groups, nor differ.
  std::vector<FemCase> runs = reuse.runs;
  for (std::size_t k = 0; k < runs.size(); ++k) runs[k].id = std::to_string(k);
  const auto finished = [&](std::size_t run) {
    for (const FemShare& share : reuse.shares) {
      if (share.run == run) on_case();
    }
  };
  const std::string program = fem_program();
  const TemporaryFolder folder("ddem-fem");
  Json document{{"schema", 1}, {"cases", Json::array()}};
  for (const FemCase& c : runs) document["cases"].push_back(case_json(c));
  const auto input = folder.path() / "cases.json", output = folder.path() / "signals.h5";
  write_json(input, document);
  std::size_t done = 0;
  // What it and MPI make for a while lies in the folder, too, and goes with it however they end.
  const std::string place = "TMPDIR=" + folder.path().string();
  const SubprocessResult run = run_program(
      "/usr/bin/env", {place, program, input.string(), "-o", output.string(), "--progress", "--threads", std::to_string(threads)}, [&](std::string_view line) {
        if (on_case && line.starts_with("done ")) finished(done++);
      });
  if (run.exit_code == 2) throw InputError(run.standard_error.substr(0, run.standard_error.find_last_not_of('\n') + 1));
  // 3: a case was unstable; the others are in the file, and it says so itself.
  if (!run.succeeded() && run.exit_code != 3) {
    throw MachineError("ddem-fem failed (" + run.status() + "): " + run.standard_error);
  }
  const Hdf5File file = Hdf5File::open_unsealed(output);
  std::vector<FemResult> solved, results;
  for (const FemCase& c : runs) solved.push_back(read_result(file.root(), c));
  for (std::size_t k = 0; k < cases.size(); ++k) {
    results.push_back(rescaled(solved[reuse.shares[k].run], reuse.shares[k], cases[k]));
  }
  return results;
}

ContinuumMaterial continuum_material(const Scene& scene, const std::optional<SceneModuli>& moduli, Wave wave) {
  ContinuumMaterial m;
  if (moduli) {
    const auto speed = moduli->speed_of(wave, scene.assembly.periodic.y);
    const auto isotropic = moduli->isotropic();
    if (!speed || (!isotropic && !moduli->strip)) {
      throw InputError(scene.path.string() + ": [continuum]: the static moduli of this packing do not give the material of "
                                              "this wave; give young_modulus, poisson_ratio and density");
    }
    const bool bar = wave == Wave::longitudinal && !scene.assembly.periodic.y;
    m.density = moduli->moving_density;
    // A single row has no lateral contraction: without one, a bar wave is that of the row, without dispersion.
    m.poisson_ratio = bar && moduli->strip ? moduli->strip->lateral_contraction.value_or(0.0) : isotropic.value().poisson();
    // E such that the wave in question has the static speed of the very assembly.
    const double nu = m.poisson_ratio, modulus = *speed * *speed * m.density;
    m.young_modulus = bar ? modulus : wave == Wave::shear ? 2.0 * (1.0 + nu) * modulus : (1.0 - nu * nu) * modulus;
  }
  if (scene.continuum) {
    m.young_modulus = scene.continuum->young_modulus.value_or(m.young_modulus);
    m.poisson_ratio = scene.continuum->poisson_ratio.value_or(m.poisson_ratio);
    m.density = scene.continuum->density.value_or(m.density);
    if (scene.continuum->plane == Plane::strain) {
      const auto plane = references::plane_strain_constants(m.young_modulus, m.poisson_ratio);
      m.young_modulus = plane.young_modulus;
      m.poisson_ratio = plane.poisson_ratio;
    }
  }
  return m;
}

}  // namespace ddem::harness
