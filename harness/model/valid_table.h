#pragma once
// Tables of files that scenes name.

#include <string>
#include <vector>

#include "harness/io/errors.h"
#include "harness/scene/violation.h"

namespace ddem::harness {

/// Throws InputError with all that is wrong with its file.
template <class Table>
const Table& valid_table(const Checked<Table>& table) {
  if (table) return *table;
  std::vector<std::string> lines;
  for (const Violation& v : table.violations) lines.push_back(to_string(v));
  throw InputError(lines);
}

}  // namespace ddem::harness
