#pragma once
// The waves of one material: what a unit of the campaign sends through its strip.

#include <optional>
#include <vector>

#include "harness/campaign/strip_statics.h"

namespace ddem::harness {

/// One material's static references and all its waves.
struct MaterialOutcome {
  StaticOutcome statics;
  std::vector<WaveOutcome> waves;       ///< in the order of cases_of()
  std::optional<StripPicture> picture;  ///< of the material that shows_strip()
};

/// Whether the report shows this material's strip: the first random packing, model and ratio.
bool shows_strip(const StripCampaign& campaign, const StripMaterial& material);

/// What fails is in the outcomes: it does not throw but for wrong use.
MaterialOutcome run_material(const StripCampaign& campaign, const StripMaterial& material,
                             StripStatics& statics, const CampaignOptions& options);

/// From a measurement: the mean speed and its scatter, or why there is none.
void take_speed(const WaveMeasurement& measurement, std::optional<double>& speed,
                std::optional<double>& stddev, std::string& failure);
/// Signals with their windows and picks, for figures.
Recording record(const std::vector<std::vector<double>>& signals, double dt, const ProbeLayout& layout,
                 const WaveContext& context, const std::optional<WaveMeasurement>& measurement);

}  // namespace ddem::harness
