#include "harness/run/noise_run.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "dem/core/packing.h"
#include "dem/spectra/spectra.h"

namespace ddem::harness {
namespace {

constexpr long kFewestSteps = 10'000, kMostNoiseSteps = 100'000;
constexpr double kFlutterStep = 0.5, kFlutterWork = 2e9;
constexpr std::size_t kReceivers = 32;
constexpr int kSampleEvery = 16;
// In a run that neither grows nor decays, the root mean squares of 32 discs' noise over two quarters (of 600 samples or
// more each) differ by 1/sqrt(2 * 32 * 600) = 0.5 %, or by a few per cent where slow beats prevail.
constexpr double kAmplitudeScatter = 0.05;

std::vector<double> noise(std::mt19937_64& generator, std::size_t n, double amplitude) {
  std::vector<double> values(n);
  // Not a distribution of the library: those differ between implementations.
  for (double& v : values) v = amplitude * (static_cast<double>(generator() >> 11) * 0x1.0p-52 - 1.0);
  return values;
}

/// Root mean square of how the samples of a range differ from those before: rigid displacements, which last for ever,
/// drop out.
double amplitude(const Signals& s, std::size_t from, std::size_t to) {
  double sum = 0.0;
  for (const auto* component : {&s.ux, &s.uy}) {
    for (const std::vector<double>& u : *component) {
      for (std::size_t n = std::max<std::size_t>(1, from); n < to; ++n) sum += (u[n] - u[n - 1]) * (u[n] - u[n - 1]);
    }
  }
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, to - from)));
}

}  // namespace

// What grows has a share of 1/sqrt(2 discs) of the noise, and stands out when it has grown beyond all of it, in three quarters of
// a run.
double steps_to_see(double growth, std::size_t discs) { return 0.5 * std::log(2.0 * static_cast<double>(discs)) / (0.75 * growth); }

NoiseRun run_noise(const ddem::Assembly& assembly, SimulationInput input, double work) {
  std::mt19937_64 generator(1);
  const double size = 1e-6 * mean_radius(assembly.packing);
  const std::size_t n = assembly.size();
  input.initial = {};
  input.initial.ux = noise(generator, n, size);
  input.initial.uy = noise(generator, n, size);
  input.drive.reset();
  input.receivers.clear();
  const std::size_t stride = std::max<std::size_t>(1, n / kReceivers);
  for (std::size_t d = 0; d < n; d += stride) input.receivers.push_back({{static_cast<int>(d)}});
  input.sample_every = kSampleEvery;
  const double step = static_cast<double>(assembly.bonds.size()) * std::max(1, input.deformation.evaluations);
  input.steps = std::clamp(static_cast<long>(work / std::max(1.0, step)), kFewestSteps, kMostNoiseSteps);

  const SimulationResult result = simulate(assembly, input);
  NoiseRun run;
  run.steps = result.steps_done;
  run.diverged = result.breakdown.has_value();
  run.detectable = steps_to_see(1.0, n) / static_cast<double>(std::max<long>(1, run.steps));
  const std::size_t samples = result.signals.time.size(), quarter = samples / 4;
  if (quarter < 2) {
    run.growth = run.diverged ? 1.0 : 0.0;
    return run;
  }
  const double third = amplitude(result.signals, 2 * quarter, 3 * quarter), last = amplitude(result.signals, 3 * quarter, 4 * quarter);
  const double steps = static_cast<double>(quarter) * kSampleEvery;
  run.resolution = kAmplitudeScatter / steps;
  if (third > 0.0 && last > 0.0) run.growth = std::expm1(std::log(last / third) / steps);
  return run;
}

NoiseFlutter flutter_from_noise(const ddem::Assembly& assembly, const ContactParameters& contact, const DeformationParameters& deformation, const HeldDofs& held) {
  NoiseFlutter flutter;
  flutter.largest_frequency = largest_converged_frequency(assembly, contact, deformation, held);
  SimulationInput in;
  in.contact = contact;
  in.contact.kinematics = Kinematics::linear;
  in.deformation = deformation;
  in.deformation.scheme = Scheme::implicit;
  in.deformation.evaluations = 1;
  in.deformation.relaxation = 1.0;
  in.deformation.tolerance = 1e-8;  // short waves flutter: their stiffness too has to be that of converged strains, within 1e-6
  in.held = held;
  in.time_step = kFlutterStep * 2.0 / flutter.largest_frequency;
  const NoiseRun noise = run_noise(assembly, in, kFlutterWork);
  flutter.growth_rate = std::log1p(noise.growth) / in.time_step;
  const double needed = noise.detectable / in.time_step;
  flutter.detectable = needed / flutter.largest_frequency;
  flutter.found = noise.diverged || flutter.growth_rate > needed;
  return flutter;
}

}  // namespace ddem::harness
