#pragma once
// Who is bonded to whom: theory section 1. A bond joins discs i and j; n is the unit vector from i to
// the bonded image of j, `length` the distance of the centres, and the contact point lies at
// arm_i = r_i s from i, s = L / (r_i + r_j), so that arm_i + arm_j = L also for gapped and overlapping bonds.

#include <cstddef>
#include <vector>

namespace ddem {

struct Bonds {
  std::vector<int> i, j;
  std::vector<double> nx, ny, length;
  std::vector<double> stretch;  ///< s
  std::vector<double> arm_i, arm_j;

  std::size_t size() const { return i.size(); }
};

}  // namespace ddem
