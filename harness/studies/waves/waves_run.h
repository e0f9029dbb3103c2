#pragma once
// The waves of one material: what a unit of the campaign sends through its strip.

#include <optional>
#include <vector>

#include "harness/studies/strip/strip_statics.h"
#include "harness/studies/waves/waves_data.h"

namespace ddem::harness {

/// Whether the report shows this material's strip: the first random packing, model and ratio.
bool shows_strip(const StripCampaign& campaign, const StripMaterial& material);

/// What fails is in the outcomes: it does not throw but for wrong use.
WaveSet send_waves(const StripCampaign& campaign, const StripMaterial& material, Protocol protocol, StripStatics& statics,
                   const CampaignOptions& options);

/// From a measurement: the mean speed and its scatter, or why there is none.
void take_speed(const WaveMeasurement& measurement, std::optional<double>& speed,
                std::optional<double>& stddev, std::string& failure);
/// Signals with their windows and picks, for figures.
Recording record(const std::vector<std::vector<double>>& signals, double dt, const ProbeLayout& layout,
                 const WaveContext& context, const std::optional<WaveMeasurement>& measurement);

}  // namespace ddem::harness
