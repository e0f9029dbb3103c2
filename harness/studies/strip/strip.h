#pragma once
// What the studies of the strip share: its description, its assemblies and statics, each made once, and what was found.

#include <memory>
#include <string>

#include "harness/campaign/study.h"
#include "harness/studies/strip/strip_results.h"
#include "harness/studies/strip/strip_statics.h"

namespace ddem::harness {

struct Strip {
  StripCampaign spec;  ///< of the models and ratios that are judged
  CampaignOptions options;
  StripStatics statics;
  StripResults found;

  Strip(StripCampaign s, const CampaignOptions& o) : spec(std::move(s)), options(o), statics(spec, options), found{spec, {}, {}, {}, {}} {}
};

std::shared_ptr<Strip> strip_of(const StudyContext& context);

/// All that a result of the strip follows from, but for the title; of one material: whichever others there are.
std::string inputs_of(StripCampaign strip);
std::string inputs_of(const StripCampaign& strip, const StripMaterial& material);

/// Names of units that more than one study needs.
std::string statics_unit(const StripMaterial& material);  ///< "statics/random-1/dem/kt0.30"
std::string waves_unit(const StripMaterial& material, Protocol protocol);
inline constexpr const char* kContinuumUnit = "finite_elements";

/// Of every seed of a material, whose own seed does not matter.
std::vector<StripMaterial> all_seeds(const StripCampaign& strip, StripMaterial material);
/// One a model and ratio, in the order of materials_of(), of this packing (random: of the first seed).
std::vector<StripMaterial> contacts_of(const StripCampaign& strip, StripPacking packing);

inline constexpr const char* kNotRun = "not run";
/// Sections to which several studies add.
inline constexpr const char* kOverview = "Poisson's ratio and wave velocities";
inline constexpr const char* kWaves = "Waves";

}  // namespace ddem::harness
