#pragma once
// From a CSV file of any program to a recording.

#include <filesystem>
#include <string>
#include <vector>

#include "harness/run/laboratory_file.h"

namespace ddem::harness {

struct ReadRecording {
  LaboratoryRecording recording;
  std::vector<std::string> notes;  ///< what was done to the times
};

/// The columns that the spec names. A spec without sensors takes the first two after time, `distance` (m) apart. InputError on
/// columns that are not there ("did you mean"), on what is no number, on times that do not increase or have gaps, and on a band
/// beyond half of the sampling rate.
ReadRecording read_recording(const std::filesystem::path& signals, const LaboratorySpec& spec, double distance = 0.0);

}  // namespace ddem::harness
