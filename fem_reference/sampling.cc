#include "fem_reference/sampling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ddem::fem {
namespace {

constexpr double most_steps = 1e9;
constexpr double most_sample_bytes = 1e9;  // held twice, and one more time while the file is written
constexpr std::uint64_t energies = 20;

}  // namespace

std::uint64_t count_steps(const StripCase& strip, double time_step, std::size_t values) {
  const double steps = strip.time.steps ? static_cast<double>(*strip.time.steps)
                                        : std::ceil(*strip.time.end / time_step - 1e-9);
  const double bytes =
      8.0 * (1.0 + static_cast<double>(values)) * (steps / static_cast<double>(strip.sample_every) + 1.0);
  if (!(steps <= most_steps && bytes <= most_sample_bytes)) {
    throw CaseError(
        fmt::format("case \"{}\", time: {:.3g} steps of {:.3g} s make {:.3g} bytes of signals; {:.0e} "
                    "steps and {:.0e} bytes are the most",
                    strip.id, steps, time_step, bytes, most_steps, most_sample_bytes));
  }
  return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(steps));
}

EnergyAudit::EnergyAudit(std::uint64_t first_step, std::uint64_t steps)
    : next_(first_step),
      interval_(std::max<std::uint64_t>(1, (steps - std::min(steps, first_step)) / energies)) {}

void EnergyAudit::watch(const Leapfrog& leapfrog) {
  if (leapfrog.steps_done() < next_) return;
  next_ += interval_;
  const double energy = leapfrog.energy();
  if (count_++ == 0) first_ = energy;
  largest_change_ = std::max(largest_change_, std::abs(energy - first_));
}

std::optional<double> EnergyAudit::drift() const {
  if (count_ < 2 || !(first_ > 0.0) || !std::isfinite(largest_change_)) return {};
  return largest_change_ / first_;
}

}  // namespace ddem::fem
