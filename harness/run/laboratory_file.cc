#include "harness/run/laboratory_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <span>

#include "harness/scene/document.h"
#include "harness/scene/keys.h"
#include "harness/scene/nearest_name.h"
#include "harness/scene/read_value.h"
#include "harness/scene/text_file.h"

namespace ddem::harness {
namespace {

constexpr std::size_t kMostBytes = 1 << 20;
constexpr Range kAny{}, kPositive{.low = 0.0, .low_excluded = true};

constexpr KeySpec text_key(std::string_view table, std::string_view key) {
  return {table, key, ValueType::text, Dimension::none, kAny, "", "", "", nullptr};
}
constexpr KeySpec choice_key(std::string_view table, std::string_view key, std::string_view choices) {
  return {table, key, ValueType::choice, Dimension::none, kAny, choices, "", "", nullptr};
}
constexpr KeySpec quantity_key(std::string_view table, std::string_view key, Dimension dimension, Range range) {
  return {table, key, ValueType::number, dimension, range, "", "", "", nullptr};
}

constexpr KeySpec kKeys[] = {
    text_key("time", "column"),
    choice_key("time", "unit", "s | ms | us | ns"),
    text_key("sensor", "column"),
    quantity_key("sensor", "position", Dimension::length, kAny),
    quantity_key("source", "duration", Dimension::time, kPositive),
    choice_key("source", "polarity", "positive | negative | auto"),
    quantity_key("filter", "low", Dimension::frequency, kPositive),
    quantity_key("filter", "high", Dimension::frequency, kPositive),
    quantity_key("material", "density", Dimension::density, kPositive),
    choice_key("material", "wave", "p | shear | bar"),
};
constexpr std::string_view kTables[] = {"time", "sensor", "source", "filter", "material"};

class Reader {
 public:
  Reader(const Document& document, const std::string& file) : document_(document), file_(file) {}

  Checked<LaboratorySpec> read() {
    for (const TableHeader& t : document_.tables) check_table(t.name, t.line, false);
    for (const Entry& e : document_.entries) {
      if (e.table.empty() && is_list(e.key)) continue;
      values_[dotted_name(e.table, e.key)] = take(e.table, e);
    }
    for (const Element& e : document_.elements) read_sensor(e);
    if (spec_.sensors.size() < 2 && violations_.empty())
      report(0, "sensor", "", "fewer than two of them", "give a [[sensor]] with column and position for each");
    fill();
    if (!violations_.empty()) return by_line();
    return spec_;
  }

 private:
  void report(int line, const std::string& key, const std::string& value, const std::string& message, const std::string& remedy) {
    violations_.push_back({file_, line, 0, key, value, message, remedy});
  }

  Violations by_line() {
    std::stable_sort(violations_.begin(), violations_.end(), [](const Violation& a, const Violation& b) { return a.line < b.line; });
    return violations_;
  }

  bool is_list(const std::string& key) const {
    return std::any_of(document_.elements.begin(), document_.elements.end(), [&](const Element& e) { return e.name == key; });
  }

  static std::string guess(std::string_view written, std::span<const std::string_view> names) {
    const auto nearest = nearest_name(written, names);
    return nearest ? fmt::format("did you mean {}?", *nearest) : fmt::format("there are {}", fmt::join(names, ", "));
  }

  void check_table(const std::string& name, int line, bool in_list) {
    if (std::find(std::begin(kTables), std::end(kTables), name) == std::end(kTables)) {
      report(line, name, "", "unknown table", guess(name, kTables));
    } else if ((name == "sensor") != in_list) {
      report(line, name, "", in_list ? "a table in a list" : "a single table",
             in_list ? fmt::format("write [{}]", name) : "write [[sensor]], once a sensor");
    }
  }

  /// Empty, with a violation, where the key is unknown or its value wrong.
  Value take(const std::string& table, const Entry& entry) {
    std::vector<std::string_view> known;
    for (const KeySpec& spec : kKeys) {
      if (spec.table != table) continue;
      known.push_back(spec.key);
      if (spec.key != entry.key) continue;
      const ReadValue read = read_value(entry.node, spec, "", FileCheck::name);
      if (!read.message.empty()) report(entry.node.line, dotted_name(table, entry.key), entry.node.text, read.message, read.remedy);
      return read.value;
    }
    if (table.empty())
      report(entry.node.line, entry.key, entry.node.text, "stands outside of a table",
             fmt::format("there are [{}]", fmt::join(kTables, "], [")));
    else if (!known.empty())
      report(entry.node.line, dotted_name(table, entry.key), entry.node.text, "unknown key", guess(entry.key, known));
    return {};
  }

  void read_sensor(const Element& element) {
    check_table(element.name, element.line, true);
    if (element.name != "sensor") return;
    std::map<std::string, Value> values;
    const std::size_t before = violations_.size();
    for (const Entry& e : element.inside.entries) {
      if (e.table.empty())
        values[e.key] = take("sensor", e);
      else
        report(e.node.line, "sensor." + e.table, "", "unknown table", "a sensor has column and position");
    }
    const auto* column = std::get_if<std::string>(&values["column"]);
    const auto* position = std::get_if<double>(&values["position"]);
    if (violations_.size() > before) return;
    if (!column || !position) {
      report(element.line, "sensor", "", column ? "position is missing" : "column is missing",
             column ? "such as position = \"12 mm\"" : "such as column = \"a\"");
      return;
    }
    for (const SensorPlace& other : spec_.sensors) {
      if (other.column == *column)
        report(element.line, "sensor.column", *column, "is there twice", "give every sensor its own column");
      else if (other.position == *position)
        report(element.line, "sensor.position", fmt::format("{} m", *position), fmt::format("is that of {}, too", other.column),
               "two sensors at one place give no speed");
    }
    spec_.sensors.push_back({*column, *position});
  }

  template <class T>
  const T* value(const char* key) {
    const auto found = values_.find(key);
    return found == values_.end() ? nullptr : std::get_if<T>(&found->second);
  }
  template <class T>
  std::optional<T> copy(const char* key) {
    const T* found = value<T>(key);
    return found ? std::optional(*found) : std::nullopt;
  }

  void fill() {
    if (const auto* column = value<std::string>("time.column")) spec_.time_column = *column;
    if (const auto* unit = value<Choice>("time.unit")) spec_.time_unit = *time_unit(unit->name);
    LaboratoryOptions& o = spec_.options;
    o.source_duration = copy<double>("source.duration");
    if (const auto* polarity = value<Choice>("source.polarity")) o.polarity = polarity_of(polarity->name);
    const double *low = value<double>("filter.low"), *high = value<double>("filter.high");
    if (low || high) o.band = Band{low ? *low : 0.0, high ? *high : 0.0};
    if (low && high && *low >= *high) report(0, "filter", "", "low is not below high", "swap them");
    o.density = copy<double>("material.density");
    if (const auto* wave = value<Choice>("material.wave")) o.wave = wave_kind(wave->name);
    if (violations_.empty() && o.density.has_value() != o.wave.has_value())
      report(0, "material", "", o.density ? "density without wave" : "wave without density",
             "give both for a modulus: density = 2400, wave = \"p\", \"shear\" or \"bar\"");
  }

  const Document& document_;
  const std::string& file_;
  std::map<std::string, Value> values_;
  Violations violations_;
  LaboratorySpec spec_;
};

}  // namespace

Checked<LaboratorySpec> read_laboratory_file(const std::filesystem::path& path) {
  const auto text = read_text_file(path, kMostBytes, Pipes::taken);
  if (!text) return text.violations;
  return parse_laboratory_file(*text, path.string());
}

Checked<LaboratorySpec> parse_laboratory_file(std::string_view text, const std::string& name) {
  const auto document = parse_document(text, name);
  if (!document) return document.violations;
  return Reader(*document, name).read();
}

std::optional<double> time_unit(std::string_view name) {
  if (name == "s") return 1.0;
  if (name == "ms") return 1e-3;
  if (name == "us") return 1e-6;
  if (name == "ns") return 1e-9;
  return std::nullopt;
}

std::optional<Polarity> polarity_of(std::string_view word) {
  if (word == "positive") return Polarity::positive;
  if (word == "negative") return Polarity::negative;
  return std::nullopt;
}

std::optional<LaboratoryWave> wave_kind(std::string_view word) {
  for (const LaboratoryWave wave : {LaboratoryWave::p, LaboratoryWave::shear, LaboratoryWave::bar}) {
    if (word == name(wave)) return wave;
  }
  return std::nullopt;
}

}  // namespace ddem::harness
