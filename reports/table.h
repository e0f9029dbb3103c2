#pragma once
// A table, as plain data: cells are text or numbers; numbers are aligned to the right.

#include <concepts>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace ddem::reports {

/// A course over time, drawn small; 0 is the lower end of the box, 1 a line. NaN: a gap.
struct Spark {
  std::vector<double> values = {};
};

/// Built from text or any number, so that a row is written {"random", 682, 0.165}. Not finite: an en dash.
struct Cell {
  std::variant<std::string, double, Spark> value = {};

  Cell() = default;
  Cell(std::string text) : value(std::move(text)) {}
  Cell(const char* text) : value(std::string(text)) {}
  Cell(Spark spark) : value(std::move(spark)) {}
  template <typename Number>
  requires(std::integral<Number> || std::floating_point<Number>) Cell(Number number)
      : value(static_cast<double>(number)) {}
};

struct Column {
  std::string heading = {};
  std::string unit = {};
  int digits = 6;  ///< significant digits of its numbers
};

struct Table {
  std::string caption = {};
  std::vector<Column> columns = {};
  /// A row may be shorter than `columns` (the rest is blank); what is longer is an error of the renderer's
  /// caller.
  std::vector<std::vector<Cell>> rows = {};
};

}  // namespace ddem::reports
