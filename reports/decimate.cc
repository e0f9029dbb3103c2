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

std::vector<std::size_t> kept_rows(const std::vector<double>& y, std::size_t max_rows) {
  std::vector<std::size_t> rows;
  if (y.size() <= max_rows) {
    for (std::size_t i = 0; i < y.size(); ++i) rows.push_back(i);
    return rows;
  }
  Polyline finite;  // (row, value)
  for (std::size_t i = 0; i < y.size(); ++i)
    if (std::isfinite(y[i])) finite.push_back({static_cast<double>(i), y[i]});
  // At most four rows of each bucket survive.
  const double bucket = 4.0 * static_cast<double>(y.size()) / static_cast<double>(max_rows);
  for (const Point& p : decimate(finite, bucket)) rows.push_back(static_cast<std::size_t>(p.x));
  return rows;
}

}  // namespace ddem::reports
