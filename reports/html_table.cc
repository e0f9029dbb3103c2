#include <fmt/format.h>

#include <stdexcept>

#include "reports/html_parts.h"
#include "reports/number.h"

namespace ddem::reports {
namespace {

bool is_number(const Cell& cell) {
  return std::holds_alternative<double>(cell.value);
}

bool is_numeric_column(const Table& table, std::size_t column) {
  for (const auto& row : table.rows)
    if (column < row.size() && is_number(row[column])) return true;
  return false;
}

void append_cell(Markup& out, const Cell& cell, const Column& column, bool row_heading) {
  if (const double* number = std::get_if<double>(&cell.value))
    out.element("td", {{"class", "n"}}, number_text(*number, column.digits));
  else if (row_heading)
    out.element("th", {{"scope", "row"}}, std::get<std::string>(cell.value));
  else
    out.element("td", {}, std::get<std::string>(cell.value));
}

}  // namespace

void open_scroll_box(Markup& out, std::string_view label) {
  // Focusable, so that it can be scrolled by keyboard.
  out.open("div", {{"class", "scroll"}, {"tabindex", "0"}, {"role", "region"}, {"aria-label", label}});
}

void append_table(Markup& out, const Table& table) {
  for (std::size_t r = 0; r < table.rows.size(); ++r)
    if (table.rows[r].size() > table.columns.size())
      throw std::invalid_argument(fmt::format("table '{}': row {} has {} cells for {} columns", table.caption,
                                              r, table.rows[r].size(), table.columns.size()));
  open_scroll_box(out, table.caption.empty() ? "Table" : table.caption);
  out.open("table");
  if (!table.caption.empty()) out.element("caption", {}, table.caption);
  out.open("thead").open("tr");
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const Column& column = table.columns[c];
    out.element("th", {{"scope", "col"}, {"class", is_numeric_column(table, c) ? "n" : ""}},
                column.unit.empty() ? column.heading : column.heading + " (" + column.unit + ")");
  }
  out.close().close().newline().open("tbody");
  for (const auto& row : table.rows) {
    out.open("tr");
    for (std::size_t c = 0; c < table.columns.size(); ++c)
      append_cell(out, c < row.size() ? row[c] : Cell(""), table.columns[c], c == 0);
    out.close().newline();
  }
  out.close().close().close().newline();
}

}  // namespace ddem::reports
