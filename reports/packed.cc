#include "reports/packed.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace ddem::reports {

std::string base64(const std::vector<std::uint8_t>& bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < n ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= n ? digits[group >> (18 - 6 * k) & 63u] : '=';
  }
  return text;
}

std::optional<std::string> packed_numbers(const std::vector<double>& values) {
  constexpr double smallest = 1e-37, largest = 1e38, round_off = 1e-16;
  constexpr std::uint32_t not_a_number = 0x7fc00000u, half_of_the_last_bit = 0x80u;
  double scale = 0.0;
  for (const double v : values) {
    if (std::isfinite(v)) scale = std::max(scale, std::abs(v));
  }
  std::vector<std::uint8_t> bytes;
  bytes.reserve(3 * values.size());
  for (double v : values) {
    const double size = std::abs(v);
    std::uint32_t bits = not_a_number;
    if (std::isfinite(v)) {
      if (size < smallest && size < round_off * scale) v = 0.0;  // what a wave sends ahead of its front
      if (v != 0.0 && (size < smallest || size > largest)) return {};
      // A carry goes into the exponent, as it should: the next number is there.
      bits = std::bit_cast<std::uint32_t>(static_cast<float>(v)) + half_of_the_last_bit;
    }
    for (const int shift : {24, 16, 8}) bytes.push_back(static_cast<std::uint8_t>(bits >> shift));
  }
  return base64(bytes);
}

}  // namespace ddem::reports
