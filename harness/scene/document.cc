#include "harness/scene/document.h"

#include <toml++/toml.h>
#include <algorithm>

#include "dem/core/narrow.h"

namespace ddem::harness {
namespace {

constexpr int max_dots_in_a_key = 8;
constexpr int max_list_depth = 2;  // points = [[x, y]]
constexpr int max_element_depth = 2;  // [[case.criterion]]

struct Position {
  int line = 0, column = 0;
};

// Skips a string literal that starts at `at`; an unclosed one ends with its line (or with the text if it may
// have many), since the parser reports it.
std::size_t end_of_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const bool many_lines = text.substr(at, 3) == std::string(3, quote);
  const std::size_t closing = many_lines ? 3 : 1;
  for (std::size_t k = at + closing; k < text.size(); ++k) {
    if (quote == '"' && text[k] == '\\') {
      ++k;
    } else if (text[k] == quote && (closing == 1 || text.substr(k, 3) == std::string(3, quote))) {
      return k + closing;
    } else if (text[k] == '\n' && !many_lines) {
      return k;
    }
  }
  return text.size();
}

// The first key with so many dotted parts that building its tables would exhaust the stack.
Position too_deep_key(std::string_view text) {
  int dots = 0;
  int line = 1;
  std::size_t line_start = 0;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (c == '"' || c == '\'') {
      const std::size_t end = end_of_string(text, k);
      for (; k + 1 < end; ++k) {
        if (text[k] != '\n') continue;
        ++line;
        line_start = k + 1;
      }
    } else if (c == '#') {
      k = std::min(text.find('\n', k), text.size()) - 1;
      dots = 0;
    } else if (c == '.') {
      if (++dots > max_dots_in_a_key) return {line, static_cast<int>(k - line_start) + 1};
    } else if (c == '\n') {
      ++line;
      line_start = k + 1;
      dots = 0;
    } else if (std::string_view("=[]{},").find(c) != std::string_view::npos) {
      dots = 0;
    }
  }
  return {};
}

// Cuts the words of a value out of the file. Columns count code points.
class SourceLines {
 public:
  explicit SourceLines(std::string_view text) : text_(text) {
    for (std::size_t k = 0; k < text.size(); ++k) {
      if (text[k] == '\n') starts_.push_back(k + 1);
    }
  }

  std::string cut(const toml::source_region& region) const {
    const std::string_view line = line_at(region.begin.line);
    if (region.begin.column > max_bytes) return "...";
    const std::size_t begin = byte_of(line, region.begin.column);
    if (region.end.line != region.begin.line) return std::string(line.substr(begin)) + " ...";
    const std::size_t end = std::max(begin, byte_of(line, region.end.column));
    return std::string(line.substr(begin, end - begin));
  }

 private:
  std::string_view line_at(std::size_t number) const {
    if (number == 0 || number > starts_.size()) return {};
    const std::size_t begin = starts_[number - 1];
    const std::size_t end = number < starts_.size() ? starts_[number] - 1 : text_.size();
    std::string_view line = text_.substr(begin, end - begin);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line.substr(0, max_bytes);
  }

  static std::size_t byte_of(std::string_view line, std::size_t column) {
    std::size_t k = 0;
    for (std::size_t seen = 0; k < line.size(); ++k) {
      const bool starts_code_point = (static_cast<unsigned char>(line[k]) & 0xC0) != 0x80;
      if (starts_code_point && ++seen == column) return k;
    }
    return k;
  }

  // Of a line: what messages can show. It bounds the work for a line of a million values.
  static constexpr std::size_t max_bytes = 1000;

  std::string_view text_;
  std::vector<std::size_t> starts_{0};
};

Position position_of(const toml::source_region& region) {
  return {narrow<int>(region.begin.line, "line"), narrow<int>(region.begin.column, "column")};
}

std::string_view unsupported_name(const toml::node& node) {
  if (node.is_table()) return "a table";
  if (node.is_array()) return "a nested list";
  return "a date or time";
}

Node to_node(const toml::node& source, const SourceLines& lines, int depth) {
  Node node;
  const Position position = position_of(source.source());
  node.line = position.line;
  node.column = position.column;
  if (depth == 0) node.text = lines.cut(source.source());
  if (const auto* text = source.as_string()) {
    node.value = text->get();
  } else if (const auto* integer = source.as_integer()) {
    node.value = integer->get();
  } else if (const auto* number = source.as_floating_point()) {
    node.value = number->get();
  } else if (const auto* flag = source.as_boolean()) {
    node.value = flag->get();
  } else if (const auto* array = source.as_array(); array && depth < max_list_depth) {
    Node::List list;
    list.reserve(array->size());
    for (const toml::node& member : *array) list.push_back(to_node(member, lines, depth + 1));
    node.value = std::move(list);
  } else {
    node.value = Unsupported{unsupported_name(source)};
  }
  return node;
}

Document to_document(const toml::table& root, const SourceLines& lines, int depth);

void add_elements(Document& document, const std::string& name, const toml::array& array, const SourceLines& lines, int depth) {
  for (const toml::node& member : array) {
    const Position position = position_of(member.source());
    document.elements.push_back({name, position.line, position.column, to_document(*member.as_table(), lines, depth + 1)});
  }
}

Document to_document(const toml::table& root, const SourceLines& lines, int depth) {
  Document document;
  const auto add_entry = [&](const std::string& table, const toml::key& key, const toml::node& node) {
    document.entries.push_back({table, std::string(key.str()), to_node(node, lines, 0)});
  };
  for (const auto& [key, node] : root) {
    const toml::table* table = node.as_table();
    if (!table) {
      add_entry("", key, node);
      if (node.is_array_of_tables() && depth < max_element_depth) {
        add_elements(document, std::string(key.str()), *node.as_array(), lines, depth);
      }
      continue;
    }
    const std::string name(key.str());
    const Position position = position_of(key.source());
    document.tables.push_back({name, position.line, position.column});
    for (const auto& [inner_key, inner_node] : *table) add_entry(name, inner_key, inner_node);
  }
  return document;
}

}  // namespace

Checked<Document> parse_document(std::string_view text, const std::string& file_name) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  if (text.find('\0') != std::string_view::npos) {
    return Violations{{file_name, 0, 0, "", "", "not a text file", "is it the right file?"}};
  }
  const Position deep = too_deep_key(text);
  if (deep.line > 0) {
    return Violations{{file_name, deep.line, deep.column, "", "", "a key with too many dotted parts",
                       "scenes have keys of two parts at most, such as contact.normal_stiffness"}};
  }
  try {
    const toml::table root = toml::parse(text);
    return to_document(root, SourceLines(text), 0);
  } catch (const toml::parse_error& error) {
    const Position position = position_of(error.source());
    return Violations{{file_name, position.line, position.column, "", "", std::string(error.description()),
                       "see https://toml.io"}};
  }
}

}  // namespace ddem::harness
