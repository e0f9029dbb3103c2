#pragma once
// The numbers behind a figure, for reading (tables) and for other programs (CSV), and notes on what is not
// drawn.

#include <cstddef>
#include <string>
#include <vector>

#include "reports/figure.h"
#include "reports/table.h"

namespace ddem::reports {

/// Sentences on what the reader cannot see: gaps, values that a logarithmic axis or the limits leave out.
std::vector<std::string> notes_of(const Figure& figure);

/// One table for each set of series that share their x values; of long ones about `max_rows` rows.
std::vector<Table> data_tables(const Figure& figure, std::size_t max_rows);

constexpr std::size_t kAllRows = 1'000'000'000;  ///< none is thinned

struct Csv {
  std::string text = {};
  bool thinned = false;
};

/// Tidy data in SI units, one row a point: panel,kind,name,x,y and, where there are any, error, lower and
/// upper, radius and value. Series of more than max_rows/(number of series) points are thinned; their
/// extremes are kept.
Csv figure_csv(const Figure& figure, std::size_t max_rows);

}  // namespace ddem::reports
