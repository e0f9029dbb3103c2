#pragma once
// A progress bar with the time left; where there is no terminal, a line now and then.

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

namespace ddem::harness {

/// One line: "[#####.....]  50 % 10/20 label, 1 min 20 s left". The time left assumes that the rest goes as
/// fast as what is done; nothing is said of it before the first unit is done. done > total counts as total.
std::string progress_line(std::size_t done, std::size_t total, std::chrono::duration<double> elapsed,
                          std::string_view label);

/// The same for a log: "10/20 label (50 %), 1 min 20 s left".
std::string progress_log_line(std::size_t done, std::size_t total, std::chrono::duration<double> elapsed,
                              std::string_view label);

/// What a Progress of a process that was killed has left on a terminal.
void wipe_progress(int descriptor = 2);

/// What this process draws just now; for signal handlers, which end it.
void wipe_drawn_progress() noexcept;

/// Draws on `descriptor` (standard error by default) at most ten times a second. Where that is no terminal, or a dumb one,
/// it gets a line every `log_interval`, the first after a fifth of it, whether or not something was done meanwhile: short
/// work is silent, and long work is not taken for dead. Any thread may call advance(). Failures to draw are ignored: progress is not worth a run.
class Progress {
 public:
  explicit Progress(std::size_t total, std::string label = {}, int descriptor = 2,
                    std::chrono::milliseconds log_interval = std::chrono::seconds(20));
  /// Wipes the line.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void advance(std::size_t count = 1);
  /// What is being worked on.
  void set_label(std::string label);

 private:
  using Clock = std::chrono::steady_clock;

  void draw();
  void log(const std::stop_token& stop, std::chrono::milliseconds interval);

  const std::size_t total_;
  const int descriptor_;
  const bool on_terminal_;
  const Clock::time_point start_ = Clock::now();
  std::mutex mutex_;  // guards what follows
  std::string label_;
  std::size_t done_ = 0;
  Clock::time_point last_drawn_{};
  std::condition_variable_any wake_;
  std::jthread logger_;  // where there is no terminal; the last member, as it uses the others
};

}  // namespace ddem::harness
