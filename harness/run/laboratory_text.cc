#include "harness/run/laboratory_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "harness/scene/units.h"

namespace ddem::harness {
namespace {

constexpr auto index(Mark mark) {
  return static_cast<std::size_t>(mark);
}

/// As many digits as the standard deviation has to say: two of its own, seven in all at most.
std::string with_spread(double value, double stddev, std::string_view unit) {
  const int most = 6 - static_cast<int>(std::floor(std::log10(std::max(std::abs(value), 1e-12))));
  const int decimals = std::clamp(stddev > 0.0 ? std::min(most, 1 - static_cast<int>(std::floor(std::log10(stddev)))) : most, 0, 12);
  return fmt::format("{:.{}f} +- {:.2g} {}", value, decimals, stddev, unit);
}

const Outcome<Uncertain>* pick_of(const SensorReading& r, Mark mark) {
  switch (mark) {
    case Mark::peak:
      return &r.peak;
    case Mark::first_break:
      return &r.first_break;
    case Mark::centroid:
      return &r.centroid;
    case Mark::correlation:
      return nullptr;
  }
  return nullptr;
}

std::string sensor_text(const LaboratorySensor& sensor, const SensorReading& r, std::span<const Mark> marks) {
  std::string text = fmt::format("{} at {}", sensor.name, format_quantity(sensor.position, "m"));
  if (r.width > 0.0)
    text += fmt::format(": a {} wave, {} wide at half its height, noise {:.2g} % of it", r.negative ? "negative" : "positive",
                        format_quantity(r.width, "s", 3), 100.0 * std::abs(r.noise / r.height));
  text += '\n';
  const std::string* last = nullptr;  // what all marks share is said once
  for (const Mark mark : marks) {
    const Outcome<Uncertain>* pick = pick_of(r, mark);
    if (!pick) continue;
    if (pick->ok()) {
      text += fmt::format("  {:<12} {}\n", name(mark), with_spread(1e6 * pick->value().value, 1e6 * pick->value().stddev, "us"));
    } else {
      if (!last || *last != pick->error().reason) text += fmt::format("  {:<12} none: {}\n", name(mark), pick->error().reason);
      last = &pick->error().reason;
    }
  }
  return text;
}

std::string pair_text(const LaboratoryRecording& recording, const PairReading& p, std::span<const Mark> marks) {
  std::string text =
      fmt::format("{} to {}, {}\n", recording.sensors[p.from].name, recording.sensors[p.to].name, format_quantity(p.distance, "m"));
  const std::string* last = nullptr;
  for (const Mark mark : marks) {
    const auto& speed = p.speed[index(mark)];
    if (speed.ok()) {
      text += fmt::format("  {:<12} {} after {:.5g} us\n", name(mark), with_spread(speed.value().value, speed.value().stddev, "m/s"),
                          1e6 * p.delay[index(mark)].value().value);
    } else {
      if (!last || *last != speed.error().reason) text += fmt::format("  {:<12} no speed: {}\n", name(mark), speed.error().reason);
      last = &speed.error().reason;
    }
  }
  if (p.phase_velocity.ok()) {
    const PhaseVelocity& v = p.phase_velocity.value();
    text += fmt::format("  phase velocity {:.5g} m/s at {:.4g} kHz to {:.5g} m/s at {:.4g} kHz ({} frequencies with --json)\n",
                        v.speed.front(), 1e-3 * v.frequency.front(), v.speed.back(), 1e-3 * v.frequency.back(), v.frequency.size());
  } else if (!last || *last != p.phase_velocity.error().reason) {
    text += fmt::format("  no phase velocity: {}\n", p.phase_velocity.error().reason);
  }
  return text;
}

std::string mean_text(const LaboratoryResult& result, Mark mark) {
  const auto& mean = result.speed[index(mark)];
  if (!mean.ok()) return fmt::format("no wave speed by {}: {}\n", name(mark), mean.error().reason);
  const MeanSpeed& m = mean.value();
  return fmt::format("wave speed by {}: {}{}\n", name(mark), with_spread(m.mean, m.stddev, "m/s"),
                     m.scatter ? fmt::format(", {} pairs scatter by {:.2g} m/s", m.pairs, *m.scatter) : "");
}

}  // namespace

std::string laboratory_text(const LaboratoryRecording& recording, const LaboratoryOptions& options, const LaboratoryResult& result,
                            std::span<const Mark> marks) {
  std::string text = fmt::format("{} sensors, {} samples every {}\n", recording.sensors.size(), recording.sensors.front().values.size(),
                                 format_quantity(recording.dt, "s"));
  for (const std::string& note : result.notes) text += fmt::format("note: {}\n", note);
  for (std::size_t s = 0; s < result.sensors.size(); ++s) text += sensor_text(recording.sensors[s], result.sensors[s], marks);
  for (const PairReading& p : result.pairs) text += pair_text(recording, p, marks);
  for (const Mark mark : marks) {
    if (result.pairs.size() > 1) text += mean_text(result, mark);
    if (result.modulus.empty() || !result.modulus[index(mark)].ok()) continue;
    const Uncertain& m = result.modulus[index(mark)].value();
    text += fmt::format("{} = {} by {}\n", modulus_symbol(*options.wave), with_spread(1e-9 * m.value, 1e-9 * m.stddev, "GPa"), name(mark));
  }
  return text;
}

}  // namespace ddem::harness
