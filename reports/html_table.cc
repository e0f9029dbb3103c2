#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "reports/column_format.h"
#include "reports/html_parts.h"
#include "reports/number.h"

namespace ddem::reports {
namespace {

constexpr std::size_t kRowsInSight = 15;

bool is_number(const Cell& cell) {
  return std::holds_alternative<double>(cell.value);
}

bool is_numeric_column(const Table& table, std::size_t column) {
  for (const auto& row : table.rows)
    if (column < row.size() && is_number(row[column])) return true;
  return false;
}

// The numbers beside it say what matters.
void append_spark(Markup& out, const Spark& spark) {
  constexpr double width = 120.0, height = 22.0, top = 1.25;
  const double step = spark.values.size() > 1 ? width / static_cast<double>(spark.values.size() - 1) : 0.0;
  std::string path, end;
  for (std::size_t k = 0; k < spark.values.size(); ++k) {
    const double v = spark.values[k];
    if (!std::isfinite(v)) continue;
    const bool goes_on = k > 0 && std::isfinite(spark.values[k - 1]);
    end = coordinate(step * static_cast<double>(k)) + " " + coordinate(height * (1.0 - std::clamp(v, 0.0, top) / top));
    path += (goes_on ? "L" : "M") + end;
  }
  out.open("td", {{"class", "spark"}}).open("svg", {{"aria-hidden", "true"}, {"viewBox", fmt::format("-3 -3 {} {}", width + 6.0, height + 6.0)}});
  out.empty("path", {{"class", "limit"}, {"d", "M0 " + coordinate(height * (1.0 - 1.0 / top)) + "h" + coordinate(width)}});
  if (!path.empty()) out.empty("path", {{"class", "course"}, {"d", path}}).empty("path", {{"class", "now"}, {"d", "M" + end + "h0"}});
  out.close().close();
}

ColumnFormat format_of(const Table& table, std::size_t column) {
  std::vector<double> values;
  for (const auto& row : table.rows) {
    if (column < row.size() && is_number(row[column])) values.push_back(std::get<double>(row[column].value));
  }
  return {values, table.columns[column].digits};
}

void append_cell(Markup& out, const Cell& cell, const ColumnFormat& format, bool row_heading) {
  if (const double* number = std::get_if<double>(&cell.value))
    out.element("td", {{"class", "n"}}, format.text(*number));
  else if (const Spark* spark = std::get_if<Spark>(&cell.value))
    append_spark(out, *spark);
  else if (row_heading)
    out.element("th", {{"scope", "row"}}, std::get<std::string>(cell.value));
  else
    out.element("td", {}, std::get<std::string>(cell.value));
}

}  // namespace

void append_permalink(Markup& out, const std::string& anchor, std::string_view of) {
  out.text(" ").element("a", {{"class", "permalink"}, {"href", "#" + anchor}, {"aria-label", "Link to " + std::string(of)}}, "#");
}

void open_scroll_box(Markup& out, std::string_view label) {
  // Focusable, so that it can be scrolled by keyboard.
  out.open("div", {{"class", "scroll"}, {"tabindex", "0"}, {"role", "region"}, {"aria-label", label}});
}

void append_table(Markup& out, const Table& table, Folding folding) {
  for (std::size_t r = 0; r < table.rows.size(); ++r)
    if (table.rows[r].size() > table.columns.size())
      throw std::invalid_argument(fmt::format("table '{}': row {} has {} cells for {} columns", table.caption,
                                              r, table.rows[r].size(), table.columns.size()));
  const std::string name = table.caption.empty() ? "Table" : table.caption;
  const bool is_long = table.rows.size() > kRowsInSight, folded = is_long && folding == Folding::long_tables;
  if (folded) out.open("details", {{"class", "rows"}}).element("summary", {}, fmt::format("{} ({} rows)", name, table.rows.size())).newline();
  open_scroll_box(out, name);
  out.open("table", {{"class", is_long ? "long" : "short"}});
  if (!table.caption.empty() && !folded) out.element("caption", {}, table.caption);
  out.open("thead").open("tr");
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const Column& column = table.columns[c];
    out.element("th", {{"scope", "col"}, {"class", is_numeric_column(table, c) ? "n" : ""}},
                column.unit.empty() ? column.heading : column.heading + " (" + column.unit + ")");
  }
  out.close().close().newline().open("tbody");
  std::vector<ColumnFormat> formats;
  for (std::size_t c = 0; c < table.columns.size(); ++c) formats.push_back(format_of(table, c));
  for (const auto& row : table.rows) {
    out.open("tr");
    for (std::size_t c = 0; c < table.columns.size(); ++c)
      append_cell(out, c < row.size() ? row[c] : Cell(""), formats[c], c == 0);
    out.close().newline();
  }
  out.close().close().close().newline();
  if (folded) out.close().newline();
}

}  // namespace ddem::reports
