#pragma once
// All nights of a history as a page of its own.

#include <vector>

#include "harness/nightly/history.h"
#include "reports/report.h"

namespace ddem::harness::nightly {

/// A tile a night, what broke and since when, a line a metric with its course over the nights (those that lost most of their margin first),
/// and the section of a campaign's report. `nights` as read_history() gives them, at least one.
reports::Report history_page(const std::vector<Night>& nights);

}  // namespace ddem::harness::nightly
