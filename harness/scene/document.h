#pragma once
// A TOML file as plain data with positions: what the scene reader works from. The only place that knows
// toml++.

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "harness/scene/violation.h"

namespace ddem::harness {

/// A value that no key takes; `name` says what it is: "a table", "a date".
struct Unsupported {
  std::string_view name;
};

struct Node {
  using List = std::vector<Node>;
  std::variant<Unsupported, bool, std::int64_t, double, std::string, List> value;
  int line = 0, column = 0;
  std::string text;  ///< as written in the file, the first line only
};

struct TableHeader {
  std::string name;
  int line = 0, column = 0;
};

struct Entry {
  std::string table;  ///< "" at the top of the file
  std::string key;
  Node node;
};

struct Element;

struct Document {
  std::vector<TableHeader> tables;
  std::vector<Entry> entries;
  /// Arrays of tables, [[name]] and [[name.inner]], one a table; entries has each array too, as a value that no key takes.
  std::vector<Element> elements;
};

struct Element {
  std::string name;
  int line = 0, column = 0;
  Document inside;
};

/// Parses TOML 1.0. A syntax error is a Violation without a key that carries the parser's message.
/// Keys of more than eight dotted parts are refused: nesting, and with it recursion, stays bounded for any
/// input.
Checked<Document> parse_document(std::string_view text, const std::string& file_name);

}  // namespace ddem::harness
