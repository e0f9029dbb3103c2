#include "harness/scene/reference.h"

#include <fmt/format.h>

#include "harness/scene/keys.h"

namespace ddem::harness {
namespace {

/// For a cell of a table.
std::string cell(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '|') out += '\\';
    out += c;
  }
  return out;
}

std::string key_rows(std::string_view table) {
  std::string rows = "| key | value | default | |\n|---|---|---|---|\n";
  for (const KeySpec& k : scene_keys()) {
    if (k.table != table) continue;
    rows += fmt::format("| `{}` | {} | {} | {} |\n", k.key, cell(describe_value(k)),
                        k.default_text.empty() ? std::string() : fmt::format("`{}`", cell(k.default_text)),
                        cell(k.doc));
  }
  return rows;
}

}  // namespace

std::string scene_reference() {
  std::string text =
      "# Scene files\n\n"
      "A scene is a TOML file. Numbers are in SI units; a text may carry its unit, such as `\"16.5 mm\"` or "
      "`\"10 GPa\"`. Unknown keys, wrong types and\n"
      "impossible values are errors, all listed at once with line and remedy. Examples are in "
      "[harness/scenes](../scenes).\n\n"
      "This page is what `ddem scene-reference` prints, from the table that the reader itself uses.\n\n"
      "## At the top\n\n" +
      key_rows("");
  for (const TableSpec& t : scene_tables())
    text += fmt::format("\n## [{}]\n\n{}\n\n{}", t.name, cell(t.doc), key_rows(t.name));
  return text;
}

}  // namespace ddem::harness
