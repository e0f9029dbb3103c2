#include "harness/scene/values.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>

#include "harness/scene/nearest_name.h"
#include "harness/scene/read_value.h"

namespace ddem::harness {
namespace {

// A scene that says nothing but the defaults of the key table, so that they pass the same checks.
std::vector<Value> read_defaults() {
  std::string text;
  std::string_view table;
  for (const KeySpec& spec : scene_keys()) {
    if (spec.default_text.empty()) continue;
    if (spec.table != table) text += fmt::format("[{}]\n", spec.table);
    table = spec.table;
    text += fmt::format("{} = {}\n", spec.key, spec.default_text);
  }
  const Checked<Document> document = parse_document(text, "defaults");
  if (!document) throw std::logic_error("scene defaults: " + to_string(document.violations));
  std::vector<Value> values(scene_keys().size());
  for (const Entry& entry : document->entries) {
    const std::size_t row = find_key(entry.table, entry.key).value();
    const ReadValue read = read_value(entry.node, scene_keys()[row], {}, FileCheck::exists);
    if (!read.message.empty()) throw std::logic_error("scene defaults: " + entry.key + ": " + read.message);
    values[row] = read.value;
  }
  return values;
}

const std::vector<Value>& defaults() {
  static const std::vector<Value> values = read_defaults();
  return values;
}

std::vector<std::string_view> table_names() {
  std::vector<std::string_view> names;
  for (const TableSpec& table : scene_tables()) names.push_back(table.name);
  return names;
}

bool is_table(std::string_view name) {
  const std::vector<std::string_view> names = table_names();
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string suggest_table(std::string_view written) {
  const std::vector<std::string_view> names = table_names();
  if (const auto nearest = nearest_name(written, names)) return fmt::format("did you mean [{}]?", *nearest);
  return fmt::format("known tables: {}", fmt::join(names, ", "));
}

std::string suggest_key(std::string_view table, std::string_view written) {
  std::vector<std::string_view> siblings;
  std::vector<std::string_view> homes;
  for (const KeySpec& spec : scene_keys()) {
    if (spec.table == table) siblings.push_back(spec.key);
    if (spec.key == written) homes.push_back(spec.table);
  }
  if (!homes.empty()) return fmt::format("it belongs into [{}]", fmt::join(homes, "] or ["));
  if (const auto nearest = nearest_name(written, siblings)) return fmt::format("did you mean {}?", *nearest);
  return fmt::format("known keys here: {}", fmt::join(siblings, ", "));
}

}  // namespace

Values::Values(const Document& document, std::string file_name, const std::filesystem::path& base_folder, const IsRead& is_read)
    : file_name_(std::move(file_name)), tables_(document.tables), slots_(scene_keys().size()) {
  for (std::size_t row = 0; row < slots_.size(); ++row) slots_[row].value = defaults()[row];
  check_tables();
  for (const Entry& entry : document.entries) {
    if (too_many_violations()) break;
    take(entry, base_folder, is_read);
  }
}

void Values::check_tables() {
  for (const TableHeader& table : tables_) {
    if (too_many_violations()) break;
    if (is_table(table.name)) continue;
    if (find_key("", table.name)) {
      reject_at(table.line, table.column, table.name, "", "a table where a value belongs",
                "write title = \"...\"");
    } else {
      reject_at(table.line, table.column, "[" + table.name + "]", "", "unknown table",
                suggest_table(table.name));
    }
  }
}

void Values::take(const Entry& entry, const std::filesystem::path& base_folder, const IsRead& is_read) {
  if (!entry.table.empty() && !is_table(entry.table)) return;  // said once, for the table
  const std::string dotted = dotted_name(entry.table, entry.key);
  const auto row = find_key(entry.table, entry.key);
  if (!row) {
    reject_unknown(entry);
    return;
  }
  ReadValue read = read_value(entry.node, scene_keys()[*row], base_folder, is_read(dotted) ? FileCheck::exists : FileCheck::name);
  slots_[*row] = {true, std::move(read.value), entry.node.line, entry.node.column, entry.node.text};
  if (!read.message.empty()) reject(dotted, std::move(read.message), std::move(read.remedy));
}

void Values::reject_unknown(const Entry& entry) {
  const std::string dotted = dotted_name(entry.table, entry.key);
  const Node& node = entry.node;
  if (entry.table.empty() && is_table(entry.key)) {
    reject_at(node.line, node.column, dotted, node.text, "a value where a table belongs",
              fmt::format("begin the table with a line [{}]", entry.key));
  } else {
    reject_at(node.line, node.column, dotted, node.text, "unknown key", suggest_key(entry.table, entry.key));
  }
}

bool Values::too_many_violations() const {
  constexpr std::size_t more_than_anyone_reads = 1000;  // rubbish with a million keys must not take minutes
  return violations_.size() >= more_than_anyone_reads;
}

bool Values::table_given(std::string_view table) const {
  return std::any_of(tables_.begin(), tables_.end(), [&](const TableHeader& t) { return t.name == table; });
}

bool Values::has(std::string_view dotted) const {
  return !std::holds_alternative<std::monostate>(slot(dotted).value);
}

bool Values::is(std::string_view dotted, std::string_view choice) const {
  const auto* chosen = std::get_if<Choice>(&slot(dotted).value);
  return chosen && chosen->name == choice;
}

const Values::Slot& Values::slot(std::string_view dotted) const {
  const auto row = find_key(dotted);
  if (!row) throw std::logic_error("scene reader: no such key: " + std::string(dotted));
  return slots_[*row];
}

void Values::reject(std::string_view dotted, std::string message, std::string remedy) {
  const Slot& place = slot(dotted);
  if (place.given) {
    reject_at(place.line, place.column, std::string(dotted), place.text, std::move(message),
              std::move(remedy));
    return;
  }
  const std::string_view table = dotted.substr(0, dotted.find('.'));
  const auto header =
      std::find_if(tables_.begin(), tables_.end(), [&](const TableHeader& t) { return t.name == table; });
  const bool found = header != tables_.end();
  reject_at(found ? header->line : 0, found ? header->column : 0, std::string(dotted), "", std::move(message),
            std::move(remedy));
}

void Values::reject_table(std::string_view table, std::string message, std::string remedy) {
  const auto header =
      std::find_if(tables_.begin(), tables_.end(), [&](const TableHeader& t) { return t.name == table; });
  const bool found = header != tables_.end();
  reject_at(found ? header->line : 0, found ? header->column : 0, fmt::format("[{}]", table), "",
            std::move(message), std::move(remedy));
}

void Values::reject_at(int line, int column, std::string key, std::string value, std::string message,
                       std::string remedy) {
  violations_.push_back(
      {file_name_, line, column, std::move(key), std::move(value), std::move(message), std::move(remedy)});
}

}  // namespace ddem::harness
