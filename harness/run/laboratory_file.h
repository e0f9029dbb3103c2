#pragma once
// What a user says of a recording: which columns are which sensors, where those stand, and what was sent. As a TOML file:
//
//   [time]
//   column = "t"             # default: time
//   unit = "us"              # s (default), ms, us, ns
//   [[sensor]]               # two or more
//   column = "a"
//   position = "12 mm"
//   [source]
//   duration = "8 us"        # of the pulse; left out: found
//   polarity = "positive"    # positive, negative, auto (default)
//   [filter]
//   low = "50 kHz"           # one of them or both
//   high = "2 MHz"
//   [material]
//   density = 2400           # with the kind of wave: a modulus
//   wave = "p"               # p, shear, bar

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/run/laboratory.h"
#include "harness/scene/violation.h"

namespace ddem::harness {

struct SensorPlace {
  std::string column;
  double position = 0.0;  ///< m
};

struct LaboratorySpec {
  std::string time_column = "time";
  double time_unit = 1.0;  ///< s
  std::vector<SensorPlace> sensors;
  LaboratoryOptions options;
};

/// All that is wrong with a file, by line.
Checked<LaboratorySpec> read_laboratory_file(const std::filesystem::path& path);
Checked<LaboratorySpec> parse_laboratory_file(std::string_view text, const std::string& name);

/// "s", "ms", "us", "ns" in seconds.
std::optional<double> time_unit(std::string_view name);
/// "positive" and "negative"; "auto", as any other word, leaves it open.
std::optional<Polarity> polarity_of(std::string_view word);
/// "p", "shear", "bar".
std::optional<LaboratoryWave> wave_kind(std::string_view word);

}  // namespace ddem::harness
