#include "reports/decimate.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ddem::reports {

Polyline decimate(const Polyline& line, double column_width) {
  Polyline kept;
  std::size_t begin = 0;
  while (begin < line.size()) {
    const double column = std::floor(line[begin].x / column_width);
    std::size_t low = begin, high = begin, end = begin + 1;
    for (; end < line.size() && std::floor(line[end].x / column_width) == column; ++end) {
      if (line[end].y < line[low].y) low = end;
      if (line[end].y > line[high].y) high = end;
    }
    std::array<std::size_t, 4> chosen = {begin, low, high, end - 1};
    std::sort(chosen.begin(), chosen.end());
    const auto unique_end = std::unique(chosen.begin(), chosen.end());
    for (auto it = chosen.begin(); it != unique_end; ++it) kept.push_back(line[*it]);
    begin = end;
  }
  return kept;
}

}  // namespace ddem::reports
