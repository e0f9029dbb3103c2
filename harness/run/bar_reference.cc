#include "harness/run/bar_reference.h"

#include <algorithm>
#include <stdexcept>

namespace ddem::harness {
namespace {

// Samples in the drive's duration: the top of the pulse (6 %) holds 30 of them, so that the pick is off by 1e-5 of it.
constexpr double kSamples = 200.0;

}  // namespace

WaveMeasurement s0_measurement(const references::FreeStrip& strip, const ProbeLayout& layout, const WaveContext& context) {
  if (!(context.source_duration > 0.0)) throw std::invalid_argument("the S0 reference is that of a driven edge");
  double farthest = 0.0, last = 0.0;
  for (const Probe& p : layout.probes) {
    farthest = std::max(farthest, p.x - context.left_end);
    last = std::max(last, causal_window(context, p.x).end);
  }
  references::FreeStrip bar = strip;
  bar.poisson_ratio = std::max(0.0, strip.poisson_ratio);
  const references::S0Pulse pulse(bar, context.source_duration, farthest, last);
  const double dt = context.source_duration / kSamples;
  const auto samples = static_cast<std::size_t>(last / dt) + 1;
  std::vector<std::vector<double>> signals;
  for (const Probe& p : layout.probes) {
    signals.push_back(pulse.signal(p.x - context.left_end, dt, samples));
    for (double& u : signals.back()) u *= context.source_amplitude;
  }
  return measure_wave(signals, dt, layout, context);
}

}  // namespace ddem::harness
