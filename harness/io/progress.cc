#include "harness/io/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

namespace ddem::harness {
namespace {

constexpr std::chrono::milliseconds redraw_interval{100};

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

Progress::Progress(std::size_t total, std::string label, int descriptor)
    : total_(total),
      descriptor_(descriptor),
      on_terminal_(::isatty(descriptor) == 1),
      label_(std::move(label)) {
  const std::lock_guard lock(mutex_);
  draw();
}

Progress::~Progress() {
  if (on_terminal_) put("\r\033[K");
}

void Progress::advance(std::size_t count) {
  const std::lock_guard lock(mutex_);
  done_ += count;
  if (Clock::now() - last_drawn_ >= redraw_interval || done_ == total_) draw();
}

void Progress::set_label(std::string label) {
  const std::lock_guard lock(mutex_);
  label_ = std::move(label);
}

void Progress::draw() {
  if (!on_terminal_) return;
  last_drawn_ = Clock::now();
  std::string line = progress_line(done_, total_, last_drawn_ - start_, label_);
  // A wrapped line could not be redrawn by a carriage return.
  line.resize(std::min(line.size(), terminal_width(descriptor_) - 1));
  put("\r" + line + "\033[K");
}

void Progress::put(std::string_view text) const {
  [[maybe_unused]] const ssize_t written = ::write(descriptor_, text.data(), text.size());
}

}  // namespace ddem::harness
