#pragma once
// Every table and key of a scene file, in one table: what the reader accepts and what the reference says.
// A new key is a member in scene.h and a row in keys.cc, which says what it fills.

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <typeinfo>
#include <vector>

#include "harness/scene/units.h"

namespace ddem::harness {

class Values;

enum class ValueType {
  text,
  file,    ///< path of an existing file, relative to the scene's folder
  choice,  ///< one of KeySpec::choices
  number,  ///< number in SI units, or text with a unit
  integer,
  boolean,
  counts,   ///< list of two integers
  indices,  ///< list of different integers
  points,   ///< list of [x, y]
};

/// The values that a number, an integer or each member of a list may take.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_excluded = false, high_excluded = false;
  bool zero_excluded = false;

  bool contains(double value) const;
};

/// "greater than 0", "from 1 to 10", "different from 0"; empty if every number will do.
std::string describe(const Range& range);

struct KeySpec {
  std::string_view table, key;
  ValueType type = ValueType::text;
  Dimension dimension = Dimension::none;
  Range range{};
  std::string_view choices{};  ///< "random | hexagonal | file", in the order of the enumerators in scene.h
  std::string_view default_text{};  ///< as it would stand in a scene; empty: no default
  std::string_view doc{};           ///< one line
  /// Sets the members of a scene that the key fills, those of the table's type `owner`: see fill.h.
  void (*fill)(const std::type_info& owner, void* table, const Values& values, std::string_view dotted) = nullptr;
};

struct TableSpec {
  std::string_view name, doc;
};

std::span<const TableSpec> scene_tables();
std::span<const KeySpec> scene_keys();

/// Row in scene_keys(). `table` is "" for the keys at the top of the file.
std::optional<std::size_t> find_key(std::string_view table, std::string_view key);
/// The same by "table.key", or "title".
std::optional<std::size_t> find_key(std::string_view dotted);
std::string dotted_name(std::string_view table, std::string_view key);
/// The members of "random | hexagonal | file".
std::vector<std::string_view> split_names(std::string_view joined);

/// What a value of this key looks like: `a length greater than 0, such as "16.5 mm", ...`.
std::string describe_value(const KeySpec& spec);

}  // namespace ddem::harness
