#include "harness/io/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <utility>

namespace ddem::harness {
namespace {

constexpr std::chrono::milliseconds redraw_interval{100};
constexpr std::string_view kWipe = "\r\033[K";

std::atomic<int> drawn_on = -1;  // descriptor of the bar that stands on a terminal

std::string human_time(double seconds) {
  // A guess from one fast unit may be absurd; beyond 100 hours nobody reads the seconds anyway.
  const auto s = static_cast<long long>(std::min(seconds, 360000.0) + 0.5);
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {} s", s / 60, s % 60);
  return fmt::format("{} h {} min", s / 3600, s % 3600 / 60);
}

std::size_t terminal_width(int descriptor) {
  winsize size{};
  return ::ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

void put(int descriptor, std::string_view text) {
  [[maybe_unused]] const ssize_t written = ::write(descriptor, text.data(), text.size());
}

/// A terminal that understands what redraws a line.
bool can_redraw(int descriptor) {
  const char* kind = std::getenv("TERM");
  return ::isatty(descriptor) == 1 && (kind == nullptr || std::string_view(kind) != "dumb");
}

}  // namespace

std::string progress_line(std::size_t done, std::size_t total, std::chrono::duration<double> elapsed,
                          std::string_view label) {
  done = std::min(done, total);
  const double fraction = total == 0 ? 1.0 : static_cast<double>(done) / static_cast<double>(total);
  constexpr std::size_t width = 20;
  const auto filled = static_cast<std::size_t>(fraction * static_cast<double>(width));
  std::string line = fmt::format("[{}{}] {:3.0f} % {}/{}", std::string(filled, '#'),
                                 std::string(width - filled, '.'), 100.0 * fraction, done, total);
  if (!label.empty()) line += fmt::format(" {}", label);
  if (done > 0 && done < total)
    line += fmt::format(", {} left", human_time(elapsed.count() * (1.0 - fraction) / fraction));
  return line;
}

std::string progress_log_line(std::size_t done, std::size_t total, std::chrono::duration<double> elapsed,
                              std::string_view label) {
  done = std::min(done, total);
  const double fraction = total == 0 ? 1.0 : static_cast<double>(done) / static_cast<double>(total);
  const std::string left = done > 0 && done < total ? human_time(elapsed.count() * (1.0 - fraction) / fraction) + " left"
                                                    : human_time(elapsed.count()) + " so far";
  return fmt::format("{}/{}{}{} ({:.0f} %), {}", done, total, label.empty() ? "" : " ", label, 100.0 * fraction, left);
}

void wipe_progress(int descriptor) {
  if (can_redraw(descriptor)) put(descriptor, kWipe);
}

void wipe_drawn_progress() noexcept {
  if (const int descriptor = drawn_on.exchange(-1); descriptor >= 0) put(descriptor, kWipe);
}

Progress::Progress(std::size_t total, std::string label, int descriptor, std::chrono::milliseconds log_interval)
    : total_(total),
      descriptor_(descriptor),
      on_terminal_(can_redraw(descriptor)),
      label_(std::move(label)) {
  if (!on_terminal_) {
    logger_ = std::jthread([this, log_interval](const std::stop_token& stop) { log(stop, log_interval); });
    return;
  }
  const std::lock_guard lock(mutex_);
  draw();
}

Progress::~Progress() {
  wipe_drawn_progress();
}

void Progress::advance(std::size_t count) {
  const std::lock_guard lock(mutex_);
  done_ += count;
  if (Clock::now() - last_drawn_ >= redraw_interval || done_ == total_) draw();
}

void Progress::set_label(std::string label) {
  const std::lock_guard lock(mutex_);
  label_ = std::move(label);
  draw();
}

void Progress::log(const std::stop_token& stop, std::chrono::milliseconds interval) {
  std::unique_lock lock(mutex_);
  for (auto wait = interval / 5; !wake_.wait_for(lock, stop, wait, [&] { return stop.stop_requested(); }); wait = interval) {
    if (stop.stop_requested()) return;
    put(descriptor_, progress_log_line(done_, total_, Clock::now() - start_, label_) + "\n");
  }
}

void Progress::draw() {
  if (!on_terminal_) return;
  last_drawn_ = Clock::now();
  std::string line = progress_line(done_, total_, last_drawn_ - start_, label_);
  // A wrapped line could not be redrawn by a carriage return.
  line.resize(std::min(line.size(), terminal_width(descriptor_) - 1));
  drawn_on = descriptor_;
  put(descriptor_, "\r" + line + "\033[K");
}

}  // namespace ddem::harness
