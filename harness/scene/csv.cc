#include "harness/scene/csv.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <system_error>

#include "harness/scene/text_file.h"
#include "harness/scene/units.h"

namespace ddem::harness {
namespace {

constexpr std::size_t max_listed = 20;
constexpr std::size_t largest_file = std::size_t{4} << 30;

std::string_view trim_cell(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r'))
    text.remove_suffix(1);
  return text;
}

class Problems {
 public:
  explicit Problems(std::string file) : file_(std::move(file)) {}

  void add(int line, std::string_view column, std::string_view value, std::string message,
           std::string remedy) {
    if (++count_ > max_listed) return;
    list_.push_back(
        {file_, line, 1, std::string(column), printable(value, 40), std::move(message), std::move(remedy)});
  }
  bool none() const { return count_ == 0; }
  Violations take() {
    if (count_ > max_listed) {
      list_.push_back({file_, 0, 0, "", "", fmt::format("and {} more", count_ - max_listed), ""});
    }
    return std::move(list_);
  }

 private:
  std::string file_;
  Violations list_;
  std::size_t count_ = 0;
};

// Lines with their numbers, without comments and without the empty lines at the end.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {
    if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
    rest_ = rest_.substr(0, rest_.find_last_not_of(" \t\r\n") + 1);
  }

  bool next() {
    while (!rest_.empty()) {
      const std::size_t end = rest_.find('\n');
      line_ = trim_cell(rest_.substr(0, end));
      rest_ = end == std::string_view::npos ? std::string_view{} : rest_.substr(end + 1);
      ++number_;
      if (!line_.starts_with('#')) return true;
    }
    return false;
  }
  std::string_view line() const { return line_; }
  int number() const { return number_; }

 private:
  std::string_view rest_, line_;
  int number_ = 0;
};

// The fields of a line in place: `fields` are views. Returns how many there are, which may exceed what fits.
template <std::size_t n>
std::size_t split(std::string_view line, std::array<std::string_view, n>& fields) {
  for (std::size_t count = 0;; ++count) {
    const std::size_t comma = line.find(',');
    if (count < n) fields[count] = trim_cell(line.substr(0, comma));
    if (comma == std::string_view::npos) return count + 1;
    line.remove_prefix(comma + 1);
  }
}

// std::from_chars takes no plus sign, which other programs write.
std::string_view without_plus(std::string_view field) {
  const bool plus = field.size() > 1 && field[0] == '+' && field[1] != '-';
  return field.substr(plus ? 1 : 0);
}

// Each returns what is wrong with the field, "" if nothing is.
std::string_view read_field(std::string_view field, double& value) {
  field = without_plus(field);
  const auto [stop, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error == std::errc::result_out_of_range) return "too large or too small to be represented";
  if (error != std::errc{} || stop != field.data() + field.size()) return "not a number";
  if (!std::isfinite(value)) return "not a finite number";
  // The smallest that a file of ours holds may be round-off of 0; the largest is that of scenes.
  return std::abs(value) <= magnitude_of(Dimension::length).most ? "" : "too large";
}

std::string_view read_field(std::string_view field, int& value) {
  field = without_plus(field);
  const auto [stop, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error == std::errc::result_out_of_range) return "too large";
  if (error != std::errc{} || stop != field.data() + field.size()) return "not a whole number";
  return value >= 0 ? "" : "negative";
}

// What programs of other countries and other systems write.
std::string other_separator(std::string_view line) {
  if (line.find_first_of(";\t") != std::string_view::npos) return ", separated by commas and with points in the numbers";
  if (line.find('\r') != std::string_view::npos) return ", and end lines with a line feed";
  return line.ends_with(',') ? ", without a comma at the end" : "";
}

template <class Number, std::size_t n>
bool read_row(const Lines& lines, const std::array<std::string_view, n>& names, std::array<Number, n>& row,
              Problems& problems) {
  std::array<std::string_view, n> fields;
  const std::size_t count = split(lines.line(), fields);
  if (count != n) {
    problems.add(lines.number(), "row", lines.line(),
                 fmt::format("{} fields instead of {}", lines.line().empty() ? 0 : count, n),
                 fmt::format("write {}{}", fmt::join(names, ","), other_separator(lines.line())));
    return false;
  }
  bool good = true;
  for (std::size_t k = 0; k < n; ++k) {
    const std::string_view problem = read_field(fields[k], row[k]);
    if (problem.empty()) continue;
    problems.add(lines.number(), names[k], fields[k], std::string(problem),
                 "write a finite number in SI units");
    good = false;
  }
  return good;
}

// Reads a file with header `names`, handing every good row to `take(line_number, row)`.
template <class Number, std::size_t n, class Take>
void read_rows(std::string_view text, const std::array<std::string_view, n>& names, Problems& problems,
               Take take) {
  const std::string header = fmt::format("{}", fmt::join(names, ","));
  Lines lines(text);
  if (!lines.next()) {
    problems.add(0, "", "", "an empty file", "begin with the header " + header);
    return;
  }
  std::array<std::string_view, n> found;
  if (split(lines.line(), found) != n || found != names) {
    problems.add(lines.number(), "header", lines.line(), "not the header of this kind of file",
                 "write " + header + other_separator(lines.line()));
    return;
  }
  bool any = false;
  std::array<Number, n> row{};
  while (lines.next()) {
    any = true;
    if (read_row(lines, names, row, problems)) take(lines.number(), row);
  }
  if (!any) problems.add(lines.number(), "", "", "no rows after the header", "write one row for each");
}

// A parser applied to a file.
template <class Parse>
auto parse_file(const std::filesystem::path& path, Parse parse)
    -> decltype(parse(std::string_view{}, std::string{})) {
  const Checked<std::string> text = read_text_file(path, largest_file);
  if (!text) return text.violations;
  return parse(*text, path.string());
}

}  // namespace

Checked<DiscTable> parse_disc_table(std::string_view text, const std::string& name) {
  Problems problems(name);
  DiscTable table;
  const std::array<std::string_view, 3> names{"x", "y", "radius"};
  read_rows<double>(text, names, problems, [&](int line, const std::array<double, 3>& row) {
    if (!(row[2] > 0.0)) {
      problems.add(line, "radius", fmt::format("{}", row[2]), "must be greater than 0", "write it in metres");
    } else if (std::string size = magnitude_problem(row[2], Dimension::length); !size.empty()) {
      problems.add(line, "radius", fmt::format("{}", row[2]), std::move(size), "write it in metres");
    }
    table.x.push_back(row[0]);
    table.y.push_back(row[1]);
    table.radius.push_back(row[2]);
  });
  if (!problems.none()) return problems.take();
  return table;
}

Checked<BondTable> parse_bond_table(std::string_view text, const std::string& name) {
  Problems problems(name);
  BondTable table;
  const std::array<std::string_view, 2> names{"i", "j"};
  read_rows<int>(text, names, problems, [&](int line, const std::array<int, 2>& row) {
    if (row[0] == row[1]) {
      problems.add(line, "j", fmt::format("{}", row[1]), "a disc bonded to itself", "leave the row out");
    }
    table.emplace_back(row[0], row[1]);
  });
  if (!problems.none()) return problems.take();
  return table;
}

Checked<StateTable> parse_state_table(std::string_view text, const std::string& name) {
  Problems problems(name);
  StateTable table;
  const std::array<std::string_view, 3> names{"ux", "uy", "theta"};
  read_rows<double>(text, names, problems, [&](int line, const std::array<double, 3>& row) {
    table.ux.push_back(row[0]);
    table.uy.push_back(row[1]);
    table.theta.push_back(row[2]);
    table.line.push_back(line);
  });
  if (!problems.none()) return problems.take();
  return table;
}

Checked<SieveTable> parse_sieve_table(std::string_view text, const std::string& name) {
  Problems problems(name);
  SieveTable table;
  int last_line = 0;
  const std::array<std::string_view, 2> names{"radius", "passing"};
  read_rows<double>(text, names, problems, [&](int line, const std::array<double, 2>& row) {
    const auto wrong = [&](int column, const char* message, const char* remedy) {
      problems.add(line, names[static_cast<std::size_t>(column)], fmt::format("{}", row[static_cast<std::size_t>(column)]), message, remedy);
    };
    const bool first = table.radius.empty();
    if (!(row[0] > 0.0)) wrong(0, "must be greater than 0", "write it in metres");
    if (!first && !(row[0] > table.radius.back())) wrong(0, "not larger than the radius of the row before", "sort the rows by radius");
    if (!(row[1] >= 0.0 && row[1] <= 1.0)) wrong(1, "must be from 0 to 1", "write shares of the mass, not per cent");
    if (first && row[1] != 0.0) wrong(1, "the first share must be 0", "begin with the smallest radius, below which there is nothing");
    if (!first && row[1] < table.passing.back()) wrong(1, "less than in the row before", "write shares of all that is smaller");
    table.radius.push_back(row[0]);
    table.passing.push_back(row[1]);
    last_line = line;
  });
  if (problems.none() && table.radius.size() < 2) problems.add(last_line, "radius", "", "a single row", "a curve has two points or more");
  if (problems.none() && table.passing.back() != 1.0)
    problems.add(last_line, "passing", fmt::format("{}", table.passing.back()), "the last share must be 1", "end with the largest radius, which nothing exceeds");
  if (!problems.none()) return problems.take();
  return table;
}

int line_of_row(const std::filesystem::path& path, std::size_t row) {
  const Checked<std::string> text = read_text_file(path, largest_file);
  if (!text) return 0;
  Lines lines(*text);
  for (std::size_t k = 0; k < row + 2; ++k) lines.next();  // the header, and the rows up to this one
  return lines.number();
}

Checked<DiscTable> read_disc_table(const std::filesystem::path& path) {
  return parse_file(path, parse_disc_table);
}
Checked<BondTable> read_bond_table(const std::filesystem::path& path) {
  return parse_file(path, parse_bond_table);
}
Checked<StateTable> read_state_table(const std::filesystem::path& path) {
  return parse_file(path, parse_state_table);
}
Checked<SieveTable> read_sieve_table(const std::filesystem::path& path) {
  return parse_file(path, parse_sieve_table);
}

void append_number(std::string& text, double value) {
  if (!std::isfinite(value)) throw std::invalid_argument("a number that is not finite cannot be written");
  std::array<char, 32> digits;  // 24 characters at most: sign, 17 digits, point, e-308
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  text.append(digits.data(), end);
}

std::string csv_text(std::string_view header, std::span<const std::span<const double>> columns) {
  std::string text = std::string(header) + "\n";
  const std::size_t rows = columns.empty() ? 0 : columns.front().size();
  for (const auto& column : columns) {
    if (column.size() != rows) throw std::invalid_argument("columns of different lengths");
  }
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      if (k > 0) text += ',';
      append_number(text, columns[k][row]);
    }
    text += '\n';
  }
  return text;
}

}  // namespace ddem::harness
