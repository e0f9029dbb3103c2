#pragma once
// Numbers as text that a script of a page reads quickly: four characters each instead of twelve.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ddem::reports {

std::string base64(const std::vector<std::uint8_t>& bytes);

/// Base64 of the first three bytes (big-endian: sign, exponent, 15 bits of the fraction) of each number in single precision,
/// rounded to nearest: within 2^-16, 1.5e-5, of the number, a sixtieth of a pixel over a thousand. What is not finite is the
/// NaN 0x7fc000; what is below 1e-37 and 1e-16 of the largest number is 0. Empty where a number above that is not between 1e-37 and
/// 1e38 in size, and has no such form.
std::optional<std::string> packed_numbers(const std::vector<double>& values);

}  // namespace ddem::reports
