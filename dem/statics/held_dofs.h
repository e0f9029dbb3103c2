#pragma once
// Which degrees of freedom of an assembly are held.

#include <cstdint>
#include <vector>

namespace ddem {

/// Degrees of freedom that do not move (1), disc by disc. Empty vectors: none.
struct HeldDofs {
  std::vector<std::uint8_t> x, y, theta;
};

}  // namespace ddem
