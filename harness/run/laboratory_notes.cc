#include "harness/run/laboratory_notes.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

namespace ddem::harness {
namespace {

// An offset or a trend below this part of the wave is none worth a word.
constexpr double kSlowestSolid = 0.1, kFastestSolid = 1e5;  // m/s, with room
constexpr double kOffset = 0.01;
// Marks that differ by more than so many standard deviations, and by more than this part of the speed, say that the wave changes.
constexpr double kBeyondNoise = 4.0, kSameShape = 1e-3;

std::string band_text(const Band& band) {
  const std::string low = band.low > 0.0 ? fmt::format("above {:.4g} kHz", 1e-3 * band.low) : "";
  const std::string high = band.high > 0.0 ? fmt::format("below {:.4g} kHz", 1e-3 * band.high) : "";
  return fmt::format("filtered without delay: {}{}{}", low, low.empty() || high.empty() ? "" : ", ", high);
}

bool has_wave(const SensorReading& r) {
  return r.width > 0.0;
}

/// The nearest sensor that has a wave: the one whose sign the others are compared with.
std::string nearest_with_wave(const LaboratoryRecording& recording, const LaboratoryResult& result) {
  const LaboratorySensor* nearest = nullptr;
  for (std::size_t s = 0; s < result.sensors.size(); ++s) {
    const LaboratorySensor& sensor = recording.sensors[s];
    if (has_wave(result.sensors[s]) && (!nearest || sensor.position < nearest->position)) nearest = &sensor;
  }
  return nearest ? nearest->name : "";
}

/// Standard deviations know of noise alone.
std::optional<std::string> marks_differ(const LaboratoryResult& result) {
  const Outcome<MeanSpeed>*least = nullptr, *most = nullptr;
  for (const auto& speed : result.speed) {
    if (!speed.ok()) continue;
    if (!least || speed.value().mean < least->value().mean) least = &speed;
    if (!most || speed.value().mean > most->value().mean) most = &speed;
  }
  if (!least || least == most) return std::nullopt;
  const MeanSpeed &slow = least->value(), &fast = most->value();
  const double apart = fast.mean - slow.mean;
  if (apart <= kBeyondNoise * std::hypot(slow.stddev, fast.stddev) || apart <= kSameShape * slow.mean) return std::nullopt;
  return fmt::format(
      "the marks give {:.5g} to {:.5g} m/s, {:.2g} % apart, and noise does not explain that: the wave changes its shape on its way, or "
      "another "
      "overlaps it; so far can a single speed be trusted, whatever its standard deviation",
      slow.mean, fast.mean, 100.0 * apart / slow.mean);
}

/// Solids carry waves of some metres (gels) to 20 km/s (diamond) a second.
std::optional<std::string> unlike_a_solid(const LaboratoryResult& result) {
  for (const auto& speed : result.speed) {
    if (!speed.ok() || (speed.value().mean >= kSlowestSolid && speed.value().mean <= kFastestSolid)) continue;
    return fmt::format("no solid carries a wave of {:.3g} m/s: is a unit missing? Distances are in m, as in --distance \"10 mm\", times in s unless "
                       "--time-unit says otherwise",
                       speed.value().mean);
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::string> notes_of(const LaboratoryRecording& recording, const LaboratoryOptions& options, const LaboratoryResult& result) {
  std::vector<std::string> notes;
  if (options.band) notes.push_back(band_text(*options.band));
  for (std::size_t s = 0; s < result.sensors.size(); ++s) {
    const SensorReading& r = result.sensors[s];
    const std::string& sensor = recording.sensors[s].name;
    if (!has_wave(r)) continue;
    const double least = kOffset * std::abs(r.height), duration = recording.dt * static_cast<double>(recording.sensors[s].values.size());
    const std::string until = fmt::format("of the quiet part up to {:.4g} us", 1e6 * r.quiet_end);
    if (std::abs(r.trend) * duration > least) {
      notes.push_back(fmt::format("{}: removed an offset of {:.3g} and a trend of {:.3g} a second, {}", sensor, r.offset, r.trend, until));
    } else if (std::abs(r.offset) > least) {
      notes.push_back(fmt::format("{}: removed an offset of {:.3g}, {}", sensor, r.offset, until));
    }
    if (r.reversed) {
      notes.push_back(fmt::format("{}: its wave has the other sign than that of {}: turned over; check its cable, or how it is mounted",
                                  sensor, nearest_with_wave(recording, result)));
    }
    if (r.clipped) notes.push_back(fmt::format("{}: the wave is clipped, or has a plateau", sensor));
  }
  if (auto note = marks_differ(result)) notes.push_back(std::move(*note));
  if (auto note = unlike_a_solid(result)) notes.push_back(std::move(*note));
  return notes;
}

}  // namespace ddem::harness
