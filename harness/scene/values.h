#pragma once
// The values of a scene file, each one checked by itself against its row of the key table: known key, right
// type and unit, within range, existing file where it is read. What combinations of keys mean is checked in check_scene.h.

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "harness/scene/document.h"
#include "harness/scene/keys.h"
#include "harness/scene/violation.h"

namespace ddem::harness {

struct Choice {
  int index = 0;
  std::string_view name;
};

/// Whether what the scene is read for reads the file of that dotted key.
using IsRead = std::function<bool(std::string_view)>;

using Point = std::array<double, 2>;
using Value = std::variant<std::monostate, bool, std::int64_t, double, std::string, std::filesystem::path,
                           Choice, std::vector<std::int64_t>, std::vector<Point>>;

/// Values by dotted key. Asking for a key that is no row of the key table throws std::logic_error, as does
/// asking for a value that is neither written, nor valid, nor has a default.
class Values {
 public:
  /// Checks all entries of `document`; what is wrong goes to violations(). Whether there is a file is looked at where its key is read.
  Values(const Document& document, std::string file_name, const std::filesystem::path& base_folder, const IsRead& is_read);

  /// Written in the file, right or wrong.
  bool given(std::string_view dotted) const { return slot(dotted).given; }
  bool table_given(std::string_view table) const;
  /// Has a value: written and right, or by default (unless written and wrong).
  bool has(std::string_view dotted) const;
  /// Has this value; false when there is none.
  bool is(std::string_view dotted, std::string_view choice) const;

  bool flag(std::string_view dotted) const { return get<bool>(dotted); }
  std::int64_t integer(std::string_view dotted) const { return get<std::int64_t>(dotted); }
  double number(std::string_view dotted) const { return get<double>(dotted); }
  const std::string& text(std::string_view dotted) const { return get<std::string>(dotted); }
  const std::filesystem::path& file(std::string_view dotted) const {
    return get<std::filesystem::path>(dotted);
  }
  const std::vector<std::int64_t>& integers(std::string_view dotted) const {
    return get<std::vector<std::int64_t>>(dotted);
  }
  const std::vector<Point>& points(std::string_view dotted) const { return get<std::vector<Point>>(dotted); }
  template <class Enum>
  Enum choice(std::string_view dotted) const {
    return static_cast<Enum>(get<Choice>(dotted).index);
  }
  const Value& value(std::string_view dotted) const { return slot(dotted).value; }

  const Violations& violations() const { return violations_; }
  /// The list of violations ends here: what follows in the file was not looked at.
  bool too_many_violations() const;
  /// Adds a violation at the place of the key, or of its table if the key is not written.
  void reject(std::string_view dotted, std::string message, std::string remedy);
  /// Adds a violation at the place of the table.
  void reject_table(std::string_view table, std::string message, std::string remedy);

 private:
  struct Slot {
    bool given = false;
    Value value;
    int line = 0, column = 0;
    std::string text;
  };

  const Slot& slot(std::string_view dotted) const;
  void take(const Entry& entry, const std::filesystem::path& base_folder, const IsRead& is_read);
  void reject_unknown(const Entry& entry);
  void check_tables();
  void reject_at(int line, int column, std::string key, std::string value, std::string message,
                 std::string remedy);

  template <class T>
  const T& get(std::string_view dotted) const {
    if (const T* found = std::get_if<T>(&slot(dotted).value)) return *found;
    throw std::logic_error("scene reader: no value of this type for " + std::string(dotted));
  }

  std::string file_name_;
  std::vector<TableHeader> tables_;
  std::vector<Slot> slots_;  // parallel to scene_keys()
  Violations violations_;
};

}  // namespace ddem::harness
