#pragma once
// The nights as a section of a report: what regressed, how near the metrics are to their limits, and how long it took.

#include <vector>

#include "harness/nightly/history.h"
#include "reports/report.h"

namespace ddem::harness::nightly {

/// The last night's trends of metrics in the order in which they need attention: regressed, those furthest beyond their
/// scatter first; then what did not pass; then what changed; then the others, those nearest to their limits first. "wall time"
/// is not among them, nor are metrics without an accuracy band, which have no scale in common with others.
std::vector<Trend> most_urgent(const std::vector<Night>& nights);

/// Of nights as read_history() gives them, the last one that of the report; the last 101 of them are drawn. On the x axis 0 is
/// the last night, and -1 that before it. Two nights are needed: of a single one it only says so.
reports::Section history_section(const std::vector<Night>& nights);

}  // namespace ddem::harness::nightly
