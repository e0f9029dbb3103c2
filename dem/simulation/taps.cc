#include "dem/simulation/taps.h"

#include <algorithm>
#include <utility>

#include "dem/kernel/step_data.h"

namespace ddem {

Taps::Taps(std::vector<int> places) : places_(std::move(places)) {
  std::sort(places_.begin(), places_.end());
  places_.erase(std::unique(places_.begin(), places_.end()), places_.end());
}

int Taps::slot_of(int place) const {
  return static_cast<int>(std::lower_bound(places_.begin(), places_.end(), place) - places_.begin());
}

void Taps::begin(int steps) {
  kept_.assign(static_cast<std::size_t>(steps), 0);
  values_.resize(kept_.size() * places_.size() * kQuad);
}

void Taps::keep(const double* motion, int level, int end) {
  std::size_t& k = kept_[level];
  double* values = values_.data() + static_cast<std::size_t>(level) * places_.size() * kQuad;
  for (; k < places_.size() && places_[k] < end; ++k) std::copy_n(motion + static_cast<std::size_t>(kQuad) * places_[k], kQuad, values + kQuad * k);
}

const double* Taps::values(int level) const { return values_.data() + static_cast<std::size_t>(level) * places_.size() * kQuad; }

}  // namespace ddem
