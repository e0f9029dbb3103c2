#pragma once
// What was done to a laboratory's signals, and what is odd about them, in words.

#include <string>
#include <vector>

#include "harness/run/laboratory.h"

namespace ddem::harness {

std::vector<std::string> notes_of(const LaboratoryRecording& recording, const LaboratoryOptions& options, const LaboratoryResult& result);

}  // namespace ddem::harness
