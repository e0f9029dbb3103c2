#pragma once
// One file a night, and what the nights say together.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/io/json.h"
#include "harness/nightly/summary.h"

namespace ddem::harness::nightly {

/// How much was computed: counts that no machine changes, so that a slow night can be told from a larger one.
struct WorkCounts {
  std::int64_t units = 0, simulations = 0, steps = 0, finite_element_runs = 0;
  std::vector<std::int64_t> seeds;
};

/// Whether wall times of both can be compared.
bool is_as_much_work(const WorkCounts& a, const WorkCounts& b);

struct Night {
  std::string time;  ///< UTC, "2026-11-22T02:00:00Z", by the clock of the machine that ran it
  Summary summary;
  WorkCounts work;
};

/// Writes FOLDER/night-NNNNNN_TIME.json, the folder made if need be, and returns its path. NNNNNN counts the nights in the
/// order in which they were added, whatever their clocks say; nights that are added at once wait for each other.
/// MachineError.
std::filesystem::path append_night(const std::filesystem::path& folder, const Night& night);

/// All nights, the one that was added first first; files that are not called as nights are left alone. Nights of earlier
/// versions, whose files are called by their time alone, come before all that are counted, by time. InputError naming every
/// file that is called as one and is none, and where there is none at all.
std::vector<Night> read_history(const std::filesystem::path& folder);

/// JSON files that read_history() leaves alone.
std::vector<std::filesystem::path> files_beside_nights(const std::filesystem::path& folder);

/// The nights of a folder that may not be there yet, or hold none. Throws as read_history().
std::vector<Night> nights_so_far(const std::filesystem::path& folder);

/// Where clocks disagree with the order in which nights were added, or a night is dated after `now` (empty: not asked):
/// a line each.
std::vector<std::string> clock_complaints(const std::vector<Night>& nights, const std::string& now = {});

inline constexpr int kWindows[] = {4, 20, 100};

/// The last night's value of a metric against the nights before it.
struct Trend {
  std::string case_id, metric, unit;
  double now = 0.0;
  std::vector<double>
      change;  ///< a window: from the median of as many nights before; NaN with fewer than two
  std::vector<double> scatter;  ///< a window: what is no change: three standard deviations by the median step
                                ///< between nights, at least least_noise()
  bool regressed = false;       ///< worse than the median by more than the scatter over one window at least
  reports::State state = reports::State::error;  ///< of the last night
};

/// Of every metric of the last night, and of those that the night before had and the last one has not, which are MISSING;
/// and of "wall time", in seconds, where less is better, and 20 % or 0.3 s no change.
std::vector<Trend> trends_of(const std::vector<Night>& nights);

/// A line a metric that changed beyond its scatter, regressed or did not pass, or of all of them; then how
/// many nights and metrics there are.
std::string trends_text(const std::vector<Night>& nights, const std::vector<Trend>& trends, bool all);

}  // namespace ddem::harness::nightly
