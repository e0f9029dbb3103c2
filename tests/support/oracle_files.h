#pragma once
// Reads the tables in tests/oracles: results of other programs and exact solutions.

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "dem/core/packing.h"
#include "tests/support/oracles.h"

namespace ddem::test {

using Row = std::vector<std::string>;

/// Data rows of a CSV file below tests/oracles, without its header and comments.
inline std::vector<Row> oracle_rows(const std::string& name) {
  std::ifstream file(std::string(kOracles) + "/" + name);
  if (!file) throw std::runtime_error("missing oracle " + name);
  std::vector<Row> rows;
  std::string line;
  bool header = true;
  while (std::getline(file, line)) {
    if (line.empty() || line[0] == '#') continue;
    if (std::exchange(header, false)) continue;
    Row row;
    std::stringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) row.push_back(field);
    if (line.back() == ',') row.emplace_back();
    rows.push_back(row);
  }
  return rows;
}

inline Packing oracle_packing(const std::string& name, Period period, double length, double width) {
  Packing p;
  for (const Row& row : oracle_rows(name)) {
    p.x.push_back(std::stod(row[0]));
    p.y.push_back(std::stod(row[1]));
    p.radius.push_back(std::stod(row[2]));
  }
  p.period = period;
  p.length = length;
  p.width = width;
  return p;
}

}  // namespace ddem::test
