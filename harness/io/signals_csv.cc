#include "harness/io/signals_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <set>
#include <stdexcept>
#include <string_view>

#include "harness/io/atomic_file.h"
#include "harness/io/errors.h"

namespace ddem::harness {
namespace {

void require_writable(const SignalTable& table) {
  if (table.names.size() != table.channels.size())
    throw std::invalid_argument("a signal table needs one name a channel");
  for (std::size_t c = 0; c < table.names.size(); ++c) {
    const std::string& name = table.names[c];
    if (name.empty() || name.find_first_of(",\"\r\n") != std::string::npos)
      throw std::invalid_argument(fmt::format("'{}' cannot be the name of a signal", name));
    if (table.channels[c].size() != table.time.size())
      throw std::invalid_argument(fmt::format("signal {} has {} samples, but there are {} times", name,
                                              table.channels[c].size(), table.time.size()));
  }
  const auto is_finite = [](double v) { return std::isfinite(v); };
  if (!std::all_of(table.time.begin(), table.time.end(), is_finite))
    throw std::invalid_argument("a signal's time is not finite");
  for (std::size_t c = 0; c < table.names.size(); ++c) {
    const auto bad = std::find_if_not(table.channels[c].begin(), table.channels[c].end(), is_finite);
    if (bad != table.channels[c].end())
      throw std::invalid_argument(fmt::format("signal {} is not finite from sample {} on", table.names[c],
                                              bad - table.channels[c].begin()));
  }
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> fields;
  for (;;) {
    const std::size_t comma = line.find(',');
    fields.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

std::string_view take_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

/// Fields quoted in messages are cut: a binary file may be one field of megabytes.
std::string quoted(std::string_view field) {
  std::string shown;
  for (const char c : field.substr(0, 40)) shown += c >= ' ' && c <= '~' ? c : '.';
  return "'" + shown + (field.size() > 40 ? "...'" : "'");
}

SignalTable read_header(std::string_view line, const std::string& path) {
  const std::vector<std::string_view> names = split(line);
  if (names.front() != "time")
    throw InputError(
        fmt::format("{}:1: the first column must be 'time', not {}", path, quoted(names.front())));
  SignalTable table;
  std::set<std::string_view> seen;
  for (std::size_t c = 1; c < names.size(); ++c) {
    if (names[c].empty() || !seen.insert(names[c]).second)
      throw InputError(
          fmt::format("{}:1: column {} has an empty or repeated name, {}", path, c + 1, quoted(names[c])));
    table.names.emplace_back(names[c]);
  }
  table.channels.resize(table.names.size());
  return table;
}

double number(std::string_view field, const std::string& place) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  const std::string problem = fmt::format("{}: {} is not a finite number", place, quoted(field));
  if (error != std::errc() || end != field.data() + field.size()) throw InputError(problem);
  if (!std::isfinite(value)) throw NonFiniteSignal(problem);
  return value;
}

}  // namespace

void write_signals_csv(const std::filesystem::path& target, const SignalTable& table) {
  require_writable(table);
  fmt::memory_buffer text;
  fmt::format_to(std::back_inserter(text), "time");
  for (const std::string& name : table.names) fmt::format_to(std::back_inserter(text), ",{}", name);
  text.push_back('\n');
  for (std::size_t n = 0; n < table.time.size(); ++n) {
    fmt::format_to(std::back_inserter(text), "{}", table.time[n]);
    for (const std::vector<double>& channel : table.channels)
      fmt::format_to(std::back_inserter(text), ",{}", channel[n]);
    text.push_back('\n');
  }
  write_file(target, {text.data(), text.size()});
}

SignalTable read_signals_csv(const std::filesystem::path& path) { return parse_signals_csv(read_file(path), path.string()); }

SignalTable parse_signals_csv(std::string_view rest, const std::string& name) {
  SignalTable table = read_header(take_line(rest), name);
  for (int line = 2; !rest.empty(); ++line) {
    const std::vector<std::string_view> fields = split(take_line(rest));
    if (fields.size() != table.names.size() + 1)
      throw InputError(fmt::format("{}:{}: {} columns, but the header names {}", name, line, fields.size(),
                                   table.names.size() + 1));
    const double time = number(fields[0], fmt::format("{}:{}: time", name, line));
    if (!table.time.empty() && !(time > table.time.back()))
      throw InputError(fmt::format("{}:{}: time {} does not increase", name, line, time));
    table.time.push_back(time);
    for (std::size_t c = 0; c < table.names.size(); ++c)
      table.channels[c].push_back(
          number(fields[c + 1], fmt::format("{}:{}: {}", name, line, table.names[c])));
  }
  return table;
}

}  // namespace ddem::harness
