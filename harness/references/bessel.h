#pragma once
// Bessel functions of the first kind of many orders at once.

#include <vector>

namespace ddem::references {

/// J_0(x) .. J_max_order(x) for x >= 0, absolute error below 1e-14 for x up to 1e5: Miller's backward
/// recurrence J_{n-1} = (2n/x) J_n - J_{n+1} from beyond the turning point, normalised by J_0 + 2 sum J_2k =
/// 1 (Abramowitz and Stegun 9.1.46 and 9.12). Cost: O(x + max_order). Throws std::invalid_argument on x < 0,
/// NaN or beyond 1e7 and on on an order
/// outside 0..1e9.
std::vector<double> bessel_j(int max_order, double x);

}  // namespace ddem::references
