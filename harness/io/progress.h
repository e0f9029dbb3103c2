#pragma once
// A progress bar with the time left: on a terminal only.

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>
#include <string_view>

namespace ddem::harness {

/// One line: "[#####.....]  50 % 10/20 label, 1 min 20 s left". The time left assumes that the rest goes as
/// fast as what is done; nothing is said of it before the first unit is done. done > total counts as total.
std::string progress_line(std::size_t done, std::size_t total, std::chrono::duration<double> elapsed,
                          std::string_view label);

/// Draws on `descriptor` (standard error by default) at most ten times a second, and not at all where that is
/// no terminal. Any thread may call advance(). Failures to draw are ignored: progress is not worth a run.
class Progress {
 public:
  explicit Progress(std::size_t total, std::string label = {}, int descriptor = 2);
  /// Wipes the line.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void advance(std::size_t count = 1);
  /// What is being worked on, shown from the next drawing on.
  void set_label(std::string label);

 private:
  using Clock = std::chrono::steady_clock;

  void draw();
  void put(std::string_view text) const;

  const std::size_t total_;
  const int descriptor_;
  const bool on_terminal_;
  const Clock::time_point start_ = Clock::now();
  std::mutex mutex_;  // guards what follows
  std::string label_;
  std::size_t done_ = 0;
  Clock::time_point last_drawn_{};
};

}  // namespace ddem::harness
