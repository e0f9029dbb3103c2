#pragma once

#include <vector>

namespace ddem::harness {

/// Of an odd or even number of values; NaN of none.
double median(std::vector<double> values);

}  // namespace ddem::harness
