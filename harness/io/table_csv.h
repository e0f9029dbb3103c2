#pragma once
// Tables of numbers that any program wrote: columns by name, read where they are needed.

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ddem::harness {

/// One line of names, then rows of as many fields. Fields are parted by commas, or where the line of names has them by semicolons
/// or tabulators, and then a decimal comma is understood, too. Names may stand in double quotes, blanks around fields do not count;
/// empty lines and lines that begin with # are left out.
class CsvTable {
 public:
  /// InputError where the file cannot be read, or has no names, the same name twice, or no rows.
  explicit CsvTable(const std::filesystem::path& path);

  const std::vector<std::string>& names() const { return names_; }
  std::size_t rows() const { return lines_.size(); }
  /// The line of a row in the file, counted from 1.
  int line(std::size_t row) const { return lines_[row].number; }

  /// The columns of these indices, row by row. InputError, with file, line and name, on a field that is no finite number, and on a
  /// row of another length than the line of names.
  std::vector<std::vector<double>> numbers(std::span<const std::size_t> columns) const;

 private:
  struct Line {
    std::string_view text;
    int number;
  };

  std::string path_, content_;
  char separator_ = ',';
  std::vector<std::string> names_;
  std::vector<Line> lines_;
};

}  // namespace ddem::harness
