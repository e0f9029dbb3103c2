#pragma once
// A calibration as JSON, and for people.

#include <optional>
#include <string>

#include "harness/calibrate/proof.h"
#include "harness/io/json.h"

namespace ddem::harness {

/// `scene` says which variant and kind of contact was calibrated.
Json calibration_json(const Scene& scene, const Calibration& calibration, const std::optional<Proof>& proof);
std::string calibration_text(const Scene& scene, const Calibration& calibration,
                             const std::optional<Proof>& proof);

}  // namespace ddem::harness
