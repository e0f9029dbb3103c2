#pragma once
// Signals as CSV: header time,disc12_ux,disc12_uy,...; one row a sample; seconds and metres (theta: radians).

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "harness/io/errors.h"

namespace ddem::harness {

/// Channel c, named names[c], was sampled as channels[c][n] at time[n].
struct SignalTable {
  std::vector<double> time;                   ///< s
  std::vector<std::string> names;             ///< such as disc12_ux; no commas, quotes or line breaks
  std::vector<std::vector<double>> channels;  ///< each as long as `time`
};

/// Numbers in their shortest form that reads back as the same double. Throws std::invalid_argument on ragged
/// channels, on names that CSV could not hold and on numbers that are not finite (a diverged run has no
/// signals to hand on); files as in AtomicFile, streams as in write_file().
void write_signals_csv(const std::filesystem::path& target, const SignalTable& table);

/// NaN or infinity where a signal should have a number.
class NonFiniteSignal : public InputError {
 public:
  using InputError::InputError;
};

/// Reads such a file. NonFiniteSignal, and InputError, with file, line and column, on a missing `time` column, repeated or empty
/// names, rows of another length, text that is not a finite number, and times that do not increase.
SignalTable read_signals_csv(const std::filesystem::path& path);
/// The same of a text that stands for the file.
SignalTable parse_signals_csv(std::string_view text, const std::string& name);

}  // namespace ddem::harness
