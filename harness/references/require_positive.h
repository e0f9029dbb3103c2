#pragma once

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace ddem::references {

/// Throws std::invalid_argument where `value` is not positive and finite; `what` names it.
inline void require_positive(double value, const char* what) {
  if (!(value > 0.0) || !std::isfinite(value))
    throw std::invalid_argument(fmt::format("the {} must be positive and finite, not {}", what, value));
}

}  // namespace ddem::references
