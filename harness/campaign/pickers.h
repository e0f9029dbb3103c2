#pragma once
// The same driven pulses measured in three ways, each against the static speed between its sections, and the bar against
// what S0 makes of it: for verdicts and the report.

#include <array>
#include <functional>
#include <optional>

#include "harness/campaign/results.h"
#include "reports/table.h"

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
std::optional<double> mean_over_seeds(const CampaignResults& results, StripCase key, std::size_t least,
                                      const std::function<std::optional<double>(const WaveOutcome&)>& error);

/// One row a model and k_t/k_n: errors of shear, P and bar by each picker, means over the random packings.
reports::Table picker_table(const CampaignResults& results);

}  // namespace ddem::harness
