#pragma once
// Measurements as figures, tables and a page.

#include "harness/bench/bench.h"
#include "reports/report.h"

namespace ddem::harness::bench {

/// Error against seconds on logarithmic axes: the finite elements by degree (if any were measured), and discs by scheme.
reports::Figure precision_figure(const std::vector<PrecisionPoint>& points);

/// The figure with a word on it, for a report on something else.
reports::Section precision_section(const std::vector<PrecisionPoint>& points);

reports::Report bench_report(const BenchResults& results);

}  // namespace ddem::harness::bench
