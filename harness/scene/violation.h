#pragma once
// What is wrong with a user's file: where, which key, which value, and what would be right.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ddem::harness {

struct Violation {
  std::string file;
  int line = 0, column = 0;  ///< counted from 1; 0 where no place in the file is to blame (a missing table)
  std::string key;      ///< dotted: contact.normal_stiffness; empty for a file that cannot be read at all
  std::string value;    ///< as written in the file; empty where there is none (a missing key)
  std::string message;  ///< what is wrong
  std::string remedy;   ///< what would be right
};

using Violations = std::vector<Violation>;

/// "scene.toml:12: contact.normal_stifness = 1e10: unknown key; did you mean normal_stiffness?"
/// A violation without a key gives the column too: "scene.toml:12:5: ...". Always one printable line.
std::string to_string(const Violation& violation);

/// One line per violation, each ended by a newline.
std::string to_string(std::span<const Violation> violations);

/// `text` as one line of valid UTF-8: control characters and broken sequences become `\xNN`, and what exceeds
/// `max_bytes` becomes "...".
std::string printable(std::string_view text, std::size_t max_bytes);

/// Either a value, or the list of everything that is wrong with it.
template <class T>
struct Checked {
  std::optional<T> value;
  Violations violations;  ///< empty exactly when there is a value

  Checked(T good) : value(std::move(good)) {}
  Checked(Violations bad) : violations(std::move(bad)) {}
  explicit operator bool() const { return value.has_value(); }
  const T& operator*() const { return *value; }
  const T* operator->() const { return &*value; }
};

}  // namespace ddem::harness
