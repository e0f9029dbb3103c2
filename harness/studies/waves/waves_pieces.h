#pragma once
// Units of waves: those of a material by one protocol.

#include <functional>
#include <memory>

#include "harness/campaign/study.h"
#include "harness/studies/strip/strip.h"

namespace ddem::harness {

/// Plans the waves among what is found in the strip, and the unit that sends them. `on_picture` gets the picture of the material that
/// shows_strip().
Piece wave_piece(const std::shared_ptr<Strip>& strip, const StripMaterial& material, Protocol protocol,
                 const std::function<void(StripPicture&&)>& on_picture = {});

/// By their names, recordings thinned.
nlohmann::json stored_waves(const StripResults& results, Protocol protocol);

void count_waves(const StripResults& results, Protocol protocol, nightly::WorkCounts& work);

}  // namespace ddem::harness
