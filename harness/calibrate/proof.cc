#include "harness/calibrate/proof.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>

#include "dem/spectra/spectra.h"
#include "dem/statics/moduli.h"
#include "harness/nightly/worker_pool.h"
#include "harness/io/errors.h"
#include "harness/model/assemble.h"
#include "harness/run/dem_run.h"
#include "harness/run/scene_moduli.h"
#include "harness/run/section_speeds.h"

namespace ddem::harness {
namespace {

// The campaign's long pulses: 8 mm in a strip of 16.5 mm. Amplitudes are small against a disc: the models are
// linear.
constexpr double kPulseOverLength = 8.0 / 16.5;
constexpr double kAmplitudeOverRadius = 1e-4;
constexpr double kStepFraction = 0.2;

/// Driven from its left end between periodic edges, measured over sections.
Scene wave_scene(const Scene& calibrated, const Packing& packing, Wave wave, double speed,
                 double step_fraction) {
  Scene s = calibrated;
  s.contact->kinematics = Kinematics::linear;
  s.contact->new_contacts = NewContacts::off;
  s.boundary = {Edge::fixed_x, Edge::free};
  Drive drive;
  drive.wave = wave;
  drive.duration = kPulseOverLength * packing.length / speed;
  drive.amplitude = kAmplitudeOverRadius * mean_radius(packing);
  s.load = drive;
  s.time = Time{};
  s.time.step = StepFraction{step_fraction};
  s.probes = ProbePairs{5, true};
  s.run.threads = 1;
  return s;
}

/// Half of what the scheme can stand, where that is less than the usual step.
double safe_step_fraction(const ddem::Assembly& a, const Scene& scene, double dem_critical) {
  const CriticalStep c = critical_step(a, contact_parameters(scene), deformation_parameters(scene), {});
  if (!c.step) throw SolverError("the lagged scheme is unstable with these discs at any step");
  return std::min(kStepFraction, 0.5 * *c.step / dem_critical);
}

ProofWave send(const Scene& calibrated, const GrippedStrip& strip, Wave wave, double static_speed,
               double critical, double step_fraction) {
  ProofWave out;
  out.static_speed = static_speed;
  try {
    const ddem::Assembly& a = strip.assembly();
    const Scene scene = wave_scene(calibrated, a.packing, wave, static_speed, step_fraction);
    RunOptions options;
    options.expected_speed = static_speed;
    options.critical_time_step = critical;
    options.warn = false;
    const DemRun run = run_assembly(scene, a, options);
    const auto sections = section_speeds(strip, run.layout);
    out.section_speed = wave == Wave::shear ? sections.s : sections.p;
    if (run.result.breakdown) {
      out.failure = describe(*run.result.breakdown, scene).what;
      return out;
    }
    const PickedSpeeds picked = picked_speeds(*run.measurement);
    out.peak = picked.peak;
    out.centroid = picked.centroid;
    if (!out.peak) out.failure = run.measurement->speed.speed.error().reason;
  } catch (const std::exception& e) {
    out.failure = e.what();
  }
  return out;
}

/// Its ends open, its edges periodic: what a P or shear wave runs through.
Scene with_ends(Scene scene) {
  scene.assembly.periodic = {false, true};
  return scene;
}

ProofSeed prove_seed(const Scene& scene, const SeedAssembly& fitted, bool ends) {
  ProofSeed out;
  out.seed = fitted.seed;
  const ContactParameters contact = contact_parameters(scene);
  const DeformationParameters deformation = deformation_parameters(scene);
  const PlaneStiffness c =
      homogenise_with_rates(fitted.assembly, contact, deformation, fitted.edge_band, {}).stiffness;
  const IsotropicModuli m = isotropic_part(c);
  out.young_modulus = m.young();
  out.poisson_ratio = m.poisson();
  const DirectionalSpeeds speeds = directional_speeds(c, moving_density(fitted.assembly));
  out.bulk_bar = speeds.bar;
  if (!ends) return out;
  const Scene open = with_ends(with_seed(scene, fitted.seed));
  const ddem::Assembly a = fitted.assembly.packing.period.x > 0.0 ? build_network(open) : fitted.assembly;
  const double critical = 2.0 / largest_frequency(a, contact, {});
  const double fraction = safe_step_fraction(a, scene, critical);
  const GrippedStrip grips = gripped(open, a);
  out.shear = send(open, grips, Wave::shear, speeds.s, critical, fraction);
  out.p = send(open, grips, Wave::longitudinal, speeds.p, critical, fraction);
  Scene free = open;
  free.assembly.periodic = {false, false};
  const ddem::Assembly strip = build_network(free);
  out.strip_bar = pull_strip(strip, contact, deformation, edge_band(free, strip)).bar_velocity();
  return out;
}

}  // namespace

Proof prove(const Scene& scene, const FoundParameters& found, std::int64_t first, int count, int threads,
            const std::function<void()>& on_progress) {
  const Scene calibrated = calibrated_scene(scene, found);
  const bool random = seed_of(scene).has_value();
  Proof proof;
  proof.unseen = random;
  if (scene.assembly.periodic.x && !random)
    proof.no_waves = "the assembly is periodic in x: there are no ends to send a wave from";
  const std::vector<SeedAssembly> assemblies = seed_assemblies(calibrated, first, count, threads);
  const auto start = std::chrono::steady_clock::now();
  proof.seeds.resize(assemblies.size());
  try {
    run_jobs(assemblies.size(), threads, [&](std::size_t k) {
      proof.seeds[k] = prove_seed(calibrated, assemblies[k], proof.no_waves.empty());
      on_progress();
    });
  } catch (const std::invalid_argument& e) {
    throw InputError(scene.path.string() + ": [assembly]: " + e.what());
  }
  proof.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return proof;
}

std::optional<MeanWithConfidence> dynamic_deviation(const Proof& proof,
                                                    std::optional<ProofWave> ProofSeed::*wave,
                                                    std::optional<double> ProofWave::*measured) {
  std::vector<double> deviations;
  for (const ProofSeed& s : proof.seeds) {
    const auto& w = s.*wave;
    if (w && w->section_speed > 0.0 && (*w).*measured)
      deviations.push_back(*((*w).*measured) / w->section_speed - 1.0);
  }
  return deviations.empty() ? std::nullopt : std::optional(mean_with_confidence(deviations));
}

std::optional<MeanWithConfidence> bar_bias(const Proof& proof) {
  std::vector<double> biases;
  for (const ProofSeed& s : proof.seeds) {
    if (s.strip_bar) biases.push_back(*s.strip_bar / s.bulk_bar - 1.0);
  }
  return biases.empty() ? std::nullopt : std::optional(mean_with_confidence(biases));
}

}  // namespace ddem::harness
