#include "dem/core/packing.h"

#include <numeric>
#include <stdexcept>

namespace ddem {

double mean_radius(const Packing& packing) {
  if (packing.radius.empty()) throw std::invalid_argument("a packing without discs has no mean radius");
  return std::accumulate(packing.radius.begin(), packing.radius.end(), 0.0) /
         static_cast<double>(packing.radius.size());
}

}  // namespace ddem
