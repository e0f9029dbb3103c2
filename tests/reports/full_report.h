#pragma once
// A report with one of everything: each kind of figure, series, axis, map, verdict and cell.

#include "reports/report.h"

namespace ddem::reports::test {

Report full_report();

}  // namespace ddem::reports::test
