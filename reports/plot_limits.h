#pragma once
// The part of the plane that a plot shows.

#include "reports/figure.h"

namespace ddem::reports {

/// The limits asked for, or else such as hold all that is drawable, error bars, references and picks
/// included.
Limits x_limits(const Plot& plot);
Limits y_limits(const Plot& plot);

}  // namespace ddem::reports
