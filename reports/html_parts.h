#pragma once
// The parts of the HTML report, each in a file of its own.

#include <cstddef>
#include <string>
#include <string_view>

#include "reports/markup.h"
#include "reports/report.h"

namespace ddem::reports {

/// How much of the figures' data goes into the page.
struct Detail {
  std::size_t csv_rows = 4000;  ///< of each figure
  std::size_t table_rows = 60;  ///< of each table behind a figure
  bool narrow_drawings = true;  ///< a second drawing for narrow screens
  std::size_t live_points = 0;  ///< of each series of an interactive figure; 0: figures are SVG alone
};

/// `anchor`: unique within the page.
void append_figure(Markup& out, const Figure& figure, const std::string& anchor, const Detail& detail);

void append_table(Markup& out, const Table& table);

/// Headcount, filters and verdicts, grouped by state, worst first.
void append_verdicts(Markup& out, const std::vector<Verdict>& verdicts);

/// Opens a box that scrolls sideways by itself on narrow screens; close with close().
void open_scroll_box(Markup& out, std::string_view label);

}  // namespace ddem::reports
