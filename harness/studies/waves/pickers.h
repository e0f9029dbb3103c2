#pragma once
// The same driven pulses measured in three ways, each against the static speed between its sections, and the bar against
// what S0 makes of it: for verdicts and the report.

#include <array>
#include <functional>
#include <optional>

#include "harness/studies/strip/strip_results.h"
#include "reports/table.h"
#include "reports/verdict.h"

namespace ddem::harness {

struct Picker {
  const char* name;
  std::optional<double> WaveOutcome::*speed;
  std::optional<double> PickedSpeeds::*s0;
};
inline constexpr std::array<Picker, 3> kPickers = {{{"peak", &WaveOutcome::speed, &PickedSpeeds::peak},
                                                    {"centroid", &WaveOutcome::centroid_speed, &PickedSpeeds::centroid},
                                                    {"correlation", &WaveOutcome::correlation_speed, &PickedSpeeds::correlation}}};

/// speed / reference - 1; empty where one of them is missing.
std::optional<double> relative_error(std::optional<double> speed, std::optional<double> reference);

/// Mean of error(wave) over the seeds of a random packing; empty where fewer than `least` seeds gave one. The seed of `key`
/// does not matter.
std::optional<double> mean_over_seeds(const StripResults& results, StripCase key, std::size_t least,
                                      const std::function<std::optional<double>(const WaveOutcome&)>& error);

/// Mean over seeds of measured / static - 1, peak to peak; empty where fewer than `least` seeds gave a velocity. Waves without one
/// are named in the verdict's reason.
std::optional<double> speed_error(const StripResults& results, StripMaterial key, Protocol protocol, StripWave wave, std::size_t least,
                                  reports::Verdict& verdict);
/// Why a wave has no velocity, into the verdict's reason.
void add_failure(reports::Verdict& verdict, const WaveOutcome& wave);

/// One row a model and k_t/k_n: errors of shear, P and bar by each picker, means over the random packings.
reports::Table picker_table(const StripResults& results);

}  // namespace ddem::harness
