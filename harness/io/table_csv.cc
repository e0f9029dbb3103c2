#include "harness/io/table_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>

#include "harness/io/atomic_file.h"
#include "harness/io/errors.h"

namespace ddem::harness {
namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::string_view unquoted(std::string_view field) {
  field = trimmed(field);
  const bool quoted = field.size() >= 2 && field.front() == '"' && field.back() == '"';
  return quoted ? trimmed(field.substr(1, field.size() - 2)) : field;
}

std::vector<std::string_view> split(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  for (;;) {
    const std::size_t end = line.find(separator);
    fields.push_back(unquoted(line.substr(0, end)));
    if (end == std::string_view::npos) return fields;
    line.remove_prefix(end + 1);
  }
}

std::optional<double> to_number(std::string_view field, bool decimal_comma) {
  std::string point;
  if (decimal_comma && field.find(',') != std::string_view::npos) {
    point = field;
    std::replace(point.begin(), point.end(), ',', '.');
    field = point;
  }
  if (field.starts_with('+')) field.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// Fields quoted in messages are cut: a binary file may be one field of megabytes.
std::string shown(std::string_view field) {
  std::string text;
  for (const char c : field.substr(0, 40)) text += c >= ' ' && c <= '~' ? c : '.';
  return "'" + text + (field.size() > 40 ? "...'" : "'");
}

}  // namespace

CsvTable::CsvTable(const std::filesystem::path& path) : path_(path.string()), content_(read_file(path)) {
  std::string_view rest = content_;
  if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);  // the mark that some programs put first
  std::string_view header;
  int header_line = 0;
  for (int number = 1; !rest.empty(); ++number) {
    const std::size_t end = rest.find('\n');
    std::string_view line = rest.substr(0, end);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (const std::string_view text = trimmed(line); text.empty() || text.front() == '#') continue;
    if (header_line > 0)
      lines_.push_back({line, number});
    else
      header = line, header_line = number;
  }
  if (header_line == 0) throw InputError(path_ + ": empty; a table has a line of names, such as time,a,b, and rows of numbers");
  separator_ = header.find(';') != std::string_view::npos ? ';' : header.find('\t') != std::string_view::npos ? '\t' : ',';
  const std::vector<std::string_view> names = split(header, separator_);
  if (std::all_of(names.begin(), names.end(), [&](std::string_view name) { return to_number(name, separator_ != ','); }))
    throw InputError(
        fmt::format("{}:{}: numbers where the names of the columns belong; put a line such as time,a,b before them", path_, header_line));
  std::set<std::string_view> seen;
  for (const std::string_view name : names) {
    if (name.empty() || !seen.insert(name).second)
      throw InputError(
          fmt::format("{}:{}: column {} has an empty or repeated name, {}", path_, header_line, names_.size() + 1, shown(name)));
    names_.emplace_back(name);
  }
  if (lines_.empty()) throw InputError(path_ + ": names of columns, but no rows");
}

std::vector<std::vector<double>> CsvTable::numbers(std::span<const std::size_t> columns) const {
  std::vector<std::vector<double>> out(columns.size());
  for (std::vector<double>& column : out) column.reserve(lines_.size());
  for (const Line& line : lines_) {
    const std::vector<std::string_view> fields = split(line.text, separator_);
    if (fields.size() != names_.size())
      throw InputError(
          fmt::format("{}:{}: {} fields, but there are {} names of columns", path_, line.number, fields.size(), names_.size()));
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const std::string_view field = fields[columns[k]];
      const std::optional<double> value = to_number(field, separator_ != ',');
      if (!value) {
        const bool units = line.number == lines_.front().number && !field.empty() &&
                           (std::isalpha(static_cast<unsigned char>(field.front())) || field.front() == '(' || field.front() == '[');
        throw InputError(fmt::format("{}:{}: {}: {} is not a finite number{}", path_, line.number, names_[columns[k]], shown(field),
                                     units ? "; is it a line of units? Put a # before it" : ""));
      }
      out[k].push_back(*value);
    }
  }
  return out;
}

}  // namespace ddem::harness
