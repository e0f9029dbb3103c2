#pragma once
// The CSV files that scenes name: discs, bonds, states. One header line, then one row a disc or bond, comma
// separated; lines that begin with # are comments, empty lines may stand at the end.

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "harness/scene/violation.h"

namespace ddem::harness {

/// Header x,y,radius: centres and radii, m. Radii are positive, and like all numbers of such files at most 1e12.
struct DiscTable {
  std::vector<double> x, y, radius;
};

/// Header i,j: discs counted from 0, different ones in each row.
using BondTable = std::vector<std::pair<int, int>>;

/// Header ux,uy,theta: m and rad, or m/s and rad/s; one row a disc.
struct StateTable {
  std::vector<double> ux, uy, theta;
  std::vector<int> line;  ///< of the row in the file
};

/// Header radius,passing: increasing radii, and the share by mass of smaller discs, which does not decrease and goes from 0 to 1.
struct SieveTable {
  std::vector<double> radius, passing;
};

/// Each reads one kind of file. What is wrong is listed by line, the first twenty problems of a file at most.
Checked<DiscTable> read_disc_table(const std::filesystem::path& path);
Checked<BondTable> read_bond_table(const std::filesystem::path& path);
Checked<StateTable> read_state_table(const std::filesystem::path& path);
Checked<SieveTable> read_sieve_table(const std::filesystem::path& path);

/// The line on which a row of such a file stands, both counted from the first: lines from 1, rows from 0.
int line_of_row(const std::filesystem::path& path, std::size_t row);

/// The same for a text; `name` stands for the file in messages.
Checked<DiscTable> parse_disc_table(std::string_view text, const std::string& name);
Checked<BondTable> parse_bond_table(std::string_view text, const std::string& name);
Checked<StateTable> parse_state_table(std::string_view text, const std::string& name);
Checked<SieveTable> parse_sieve_table(std::string_view text, const std::string& name);

/// Appends the shortest decimal that reads back as the same double. Throws std::invalid_argument for NaN and
/// infinity, which no file of ours holds.
void append_number(std::string& text, double value);

/// A CSV text: `header` as it stands ("x,y,radius"), then a row per member of the columns, which have the
/// same length.
std::string csv_text(std::string_view header, std::span<const std::span<const double>> columns);

}  // namespace ddem::harness
