#include "harness/campaign/noise_release.h"

#include "dem/simulation/simulation.h"
#include "dem/spectra/spectra.h"
#include "harness/model/assemble.h"

namespace ddem::harness {
namespace {

// The noise run: half the critical step, where the growth of N is fastest, on a patch small enough to be
// quick.
constexpr double kNoiseStepFraction = 0.5;
constexpr long kNoiseSteps = 20000;
constexpr long kImplicitNoiseSteps =
    4000;  // several passes a step, and an invariant that would show growth at once
constexpr std::int64_t kNoiseColumns = 10, kNoiseRows = 10;

/// Noise that is the same everywhere: no library's random numbers, whose distributions differ.
std::vector<double> noise(std::size_t n, std::uint64_t state) {
  std::vector<double> values(n);
  for (double& v : values) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    v = 1e-9 * (static_cast<double>(state >> 11) * 0x1.0p-52 - 1.0);
  }
  return values;
}

}  // namespace

StabilityOutcome release_noise(const StripCampaign& s, const StripMaterial& key,
                               const CampaignOptions& options) {
  StabilityOutcome out;
  out.key = key;
  out.expected_unstable = expected_unstable(s, key);
  out.steps = key.model == Model::implicit_full ? kImplicitNoiseSteps : kNoiseSteps;
  try {
    StripCampaign small = s;
    small.columns = kNoiseColumns;
    small.rows = kNoiseRows;
    Scene scene = scene_of(assembly_text(small, case_of(key, StripWave::p), true), "noise");
    if (options.disturb_scene) options.disturb_scene(scene);
    const ddem::Assembly assembly = build_assembly(scene);
    SimulationInput in;
    in.contact = contact_parameters(scene);
    in.deformation = deformation_parameters(scene);
    in.initial.ux = noise(assembly.size(), 1);
    in.initial.uy = noise(assembly.size(), 2);
    in.time_step = kNoiseStepFraction * 2.0 / largest_frequency(assembly, in.contact, {});
    in.steps = out.steps;
    const SimulationResult result = simulate(assembly, in);
    if (result.breakdown) out.diverged_step = result.breakdown->step;
  } catch (const std::exception& e) {
    out.failure = e.what();
  }
  return out;
}

std::vector<StripMaterial> lattices_with_strain(const StripCampaign& s) {
  std::vector<StripMaterial> keys;
  for (const StripMaterial& key : materials_of(s)) {
    if (key.packing == StripPacking::hexagonal && key.model != Model::dem) keys.push_back(key);
  }
  return keys;
}

}  // namespace ddem::harness
