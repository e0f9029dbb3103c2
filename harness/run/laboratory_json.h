#pragma once
// The result of a laboratory's recording for other programs.

#include "harness/io/json.h"
#include "harness/run/laboratory.h"

namespace ddem::harness {

/// Every number has a status beside it: "ok", or why it is null. SI units; signals in theirs.
Json laboratory_json(const LaboratoryRecording& recording, const LaboratoryOptions& options, const LaboratoryResult& result);

/// "first_break" and so on.
std::string key_of(Mark mark);

}  // namespace ddem::harness
