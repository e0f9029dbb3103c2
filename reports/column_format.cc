#include "reports/column_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "reports/number.h"

namespace ddem::reports {
namespace {

constexpr double kLargest = 1e7, kSmallest = 1e-4;

std::string mantissa_text(double value, int decimals) { return fmt::format("{:.{}e}", value, decimals); }

/// Whether all are as short as that: a percentage in tenths, a count.
bool have_decimals(std::span<const double> values, int decimals) {
  const double unit = std::pow(10.0, decimals);
  return std::all_of(values.begin(), values.end(), [unit](double v) {
    return !std::isfinite(v) || v == 0.0 || (std::round(v * unit) != 0.0 && std::abs(v * unit - std::round(v * unit)) < 1e-9 * std::max(1.0, std::abs(v * unit)));
  });
}

/// Decimals without zeros at the end, of a text with `decimals` of them before `end`.
int needed(const std::string& text, std::size_t end, int decimals) {
  while (decimals > 0 && text[end - 1] == '0') --end, --decimals;
  return decimals;
}

}  // namespace

ColumnFormat::ColumnFormat(std::span<const double> values, int digits) {
  double largest = 0.0, smallest = HUGE_VAL;
  for (const double v : values) {
    if (!std::isfinite(v) || v == 0.0) continue;
    largest = std::max(largest, std::abs(v));
    smallest = std::min(smallest, std::abs(v));
  }
  if (largest == 0.0) return;
  digits = std::max(digits, 1);
  for (int decimals = 0; decimals <= 2 && largest < kLargest; ++decimals) {
    if (!have_decimals(values, decimals)) continue;
    decimals_ = decimals;
    return;
  }
  const int most = std::max(0, digits - 1 - static_cast<int>(std::floor(std::log10(largest))));
  scientific_ = largest >= kLargest || largest < kSmallest || smallest < 10.0 * std::pow(10.0, -most);
  for (const double v : values) {
    if (!std::isfinite(v)) continue;
    const std::string text = scientific_ ? mantissa_text(v, digits - 1) : fmt::format("{:.{}f}", v, most);
    const std::size_t end = scientific_ ? text.find('e') : text.size();
    decimals_ = std::max(decimals_, needed(text, end, scientific_ ? digits - 1 : most));
  }
}

std::string ColumnFormat::text(double value) const {
  if (!std::isfinite(value)) return "–";
  if (!scientific_) return fixed_text(value, decimals_);
  if (value == 0.0) return "0";
  const std::string text = mantissa_text(value, decimals_);
  const std::size_t e = text.find('e');
  return fixed_text(std::strtod(text.substr(0, e).c_str(), nullptr), decimals_) + "×" + power_of_ten(std::atoi(text.c_str() + e + 1));
}

}  // namespace ddem::reports
