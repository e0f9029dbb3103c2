#include "harness/io/errors.h"
#include "harness/studies/stability/noise_release.h"

#include <fmt/format.h>

#include "dem/spectra/spectra.h"
#include "harness/model/assemble.h"
#include "harness/references/lattice_stability.h"
#include "harness/studies/strip/criteria.h"

namespace ddem::harness {
namespace {

// The noise run: half the critical step, where the growth of N is fastest, on a patch small enough to be
// quick.
constexpr double kNoiseStepFraction = 0.5, kNoiseAmplitude = 1e-9;  // of the critical step; m
constexpr long kReleaseSteps = 20000;
constexpr long kImplicitNoiseSteps =
    4000;  // several passes a step, and an invariant that would show growth at once
constexpr std::int64_t kNoiseColumns = 10, kNoiseRows = 10;

}  // namespace

std::vector<double> steady_noise(std::size_t n, std::uint64_t state, double amplitude) {
  std::vector<double> values(n);
  for (double& v : values) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    v = amplitude * (static_cast<double>(state >> 11) * 0x1.0p-52 - 1.0);
  }
  return values;
}

StabilityOutcome release_noise(const StripCampaign& s, const StripMaterial& key,
                               const CampaignOptions& options) {
  StabilityOutcome out;
  out.key = key;
  out.expected_unstable = expected_unstable(s, key);
  out.steps = key.model == Model::implicit_full ? kImplicitNoiseSteps : kReleaseSteps;
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
    in.initial.ux = steady_noise(assembly.size(), 1, kNoiseAmplitude);
    in.initial.uy = steady_noise(assembly.size(), 2, kNoiseAmplitude);
    in.time_step = kNoiseStepFraction * 2.0 / largest_frequency(assembly, in.contact, {});
    in.steps = out.steps;
    const SimulationResult result = options.solver->solve(assembly, in);
    if (result.breakdown) out.diverged_step = result.breakdown->step;
  } catch (const UnsupportedError&) {  // no failure, but what a solver cannot do
    throw;
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

bool expected_unstable(const StripCampaign& s, const StripMaterial& c) {
  if (c.model == Model::dem || c.model == Model::implicit_full || c.packing != StripPacking::hexagonal) return false;
  const bool normal = c.model == Model::lagged_normal;
  if (normal && c.stiffness_ratio > references::hexagonal_normal_ratio_limit) return true;
  const double limit = references::hexagonal_fixed_point_limit(
      normal ? references::ContactModel::ddem_normal : references::ContactModel::ddem_full, s.particle_poisson_ratio, c.stiffness_ratio);
  return s.normal_stiffness / s.particle_modulus > limit;
}

reports::Verdict noise_verdict(const StabilityOutcome& o) {
  reports::Verdict v{.case_id = case_id("stability/hexagonal", o.key), .title = title_of(o.key, "The lattice released from noise")};
  const std::string expectation =
      o.expected_unstable ? (o.key.model == Model::lagged_normal ? "theory: N is unstable above k_t/k_n = 1/3 or beyond the fixed-point limit"
                                                                 : "theory: unstable beyond the fixed-point limit")
                          : "theory: stable";
  const std::string found = o.diverged_step ? fmt::format("diverged at step {}", *o.diverged_step) : fmt::format("no divergence in {} steps", o.steps);
  v.reason = o.failure.empty() ? fmt::format("{}; {}", expectation, found) : o.failure;
  if (!o.failure.empty()) {
    v.state = reports::State::error;
  } else if (o.expected_unstable) {
    v.state = o.diverged_step ? reports::State::unstable_as_expected : reports::State::fail;
  } else {
    v.state = o.diverged_step ? reports::State::unstable : reports::State::pass;
  }
  return v;
}

}  // namespace ddem::harness
