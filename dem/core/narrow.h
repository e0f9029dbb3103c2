#pragma once
// From a wide number to a narrow one, checked: what a user writes never wraps around on its way to a loop.

#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

namespace ddem {

/// The same number as an integer of another type; throws std::invalid_argument, which names `what` and the number, where there is
/// none. Of a floating-point number the whole part.
template <class To, class From>
  requires std::is_integral_v<To> && std::is_arithmetic_v<From>
To narrow(From value, const char* what) {
  const auto refuse = [&] { throw std::invalid_argument(std::string(what) + ": " + std::to_string(value) + " is too large or too small"); };
  if constexpr (std::is_integral_v<From>) {
    if (!std::in_range<To>(value)) refuse();
  } else {
    // 2^bits is exact; NaN is none of both.
    const double above = 2.0 * static_cast<double>(To{1} << (std::numeric_limits<To>::digits - 1));
    const double below = std::is_signed_v<To> ? -above : 0.0;
    if (!(value >= below && value < above)) refuse();
  }
  return static_cast<To>(value);
}

}  // namespace ddem
