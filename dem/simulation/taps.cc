#include "dem/simulation/taps.h"

#include <algorithm>
#include <utility>

namespace ddem {

Taps::Taps(std::vector<int> places) : places_(std::move(places)) {
  std::sort(places_.begin(), places_.end());
  places_.erase(std::unique(places_.begin(), places_.end()), places_.end());
}

int Taps::slot_of(int place) const {
  return static_cast<int>(std::lower_bound(places_.begin(), places_.end(), place) - places_.begin());
}

void Taps::begin(int steps) {
  values_.resize(static_cast<std::size_t>(steps) * places_.size() * kQuad);
}

void Taps::keep(const double* motion, int level, int begin, int end) {
  const auto first = std::lower_bound(places_.begin(), places_.end(), begin);
  double* values = values_.data() + begin_of(level) + kQuad * (first - places_.begin());
  for (auto place = first; place != places_.end() && *place < end; ++place, values += kQuad) {
    std::copy_n(motion + static_cast<std::ptrdiff_t>(kQuad) * *place, kQuad, values);
  }
}

}  // namespace ddem
