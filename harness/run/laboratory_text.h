#pragma once
// The result of a laboratory's recording for people.

#include <span>
#include <string>

#include "harness/run/laboratory.h"

namespace ddem::harness {

/// Of those marks alone; sensors, pairs and means, and why a number is missing.
std::string laboratory_text(const LaboratoryRecording& recording, const LaboratoryOptions& options, const LaboratoryResult& result,
                            std::span<const Mark> marks);

}  // namespace ddem::harness
