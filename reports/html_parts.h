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
  std::string_view program = {};  ///< that made the figures: its version and commit
};

/// `anchor`: unique within the page.
void append_figure(Markup& out, const Figure& figure, const std::string& anchor, const Detail& detail);

/// A long table stands folded where it may.
enum class Folding { long_tables, none };
void append_table(Markup& out, const Table& table, Folding folding = Folding::long_tables);

/// "#" behind a heading: its address.
void append_permalink(Markup& out, const std::string& anchor, std::string_view of);

/// Headcount, what broke, and what was found: the page opens with it.
void append_conclusion(Markup& out, const Report& report);

/// The cases that passed with the least margin.
void append_nearest(Markup& out, const std::vector<Verdict>& verdicts);

/// "pass", "skip", "fail" or "error", for the style sheet.
std::string_view state_class(State state);

void append_badge(Markup& out, State state);

/// Id of a case in the page.
std::string case_anchor(std::string_view case_id);

/// Margins, filters and verdicts, grouped by state, worst first.
void append_verdicts(Markup& out, const std::vector<Verdict>& verdicts);

/// Opens a box that scrolls sideways by itself on narrow screens; close with close().
void open_scroll_box(Markup& out, std::string_view label);

}  // namespace ddem::reports
