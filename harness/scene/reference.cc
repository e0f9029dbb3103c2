#include "harness/scene/reference.h"

#include <fmt/format.h>

#include "harness/scene/key_rules.h"

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

/// What numbers of each dimension may be in size.
std::string magnitudes() {
  std::string text = "Numbers other than 0 lie, in size, between these:";
  for (const Dimension d : {Dimension::length, Dimension::time, Dimension::stress, Dimension::density, Dimension::stiffness, Dimension::none}) {
    const Magnitude m = magnitude_of(d);
    text += fmt::format(" {} {:g} and {:g}{}{}{}", dimension_name(d), m.least, m.most, si_unit(d).empty() ? "" : " ", si_unit(d),
                        d == Dimension::none ? ".\n\n" : ",");
  }
  return text;
}

std::string key_rows(std::string_view table) {
  std::string rows = "| key | value | default | | beside others |\n|---|---|---|---|---|\n";
  for (const KeySpec& k : scene_keys()) {
    if (k.table != table) continue;
    rows += fmt::format("| `{}` | {} | {} | {} | {} |\n", k.key, cell(describe_value(k)),
                        k.default_text.empty() ? std::string() : fmt::format("`{}`", cell(k.default_text)),
                        cell(k.doc), cell(describe_rules(k)));
  }
  return rows;
}

}  // namespace

std::string scene_reference() {
  std::string text =
      "# Scene files\n\n"
      "A scene is a TOML file. Numbers are in SI units; a text may carry its unit, such as `\"16.5 mm\"` or "
      "`\"10 GPa\"`. Unknown keys, wrong types and\n"
      "impossible values are errors, all listed at once with line and remedy; so is a key that does nothing beside the others, as "
      "the last\ncolumn of each table says. Examples are in [harness/scenes](../scenes).\n\n" +
      magnitudes() +
      "This page is what `ddem scene-reference` prints, from the table that the reader itself uses.\n\n"
      "## At the top\n\n" +
      key_rows("");
  for (const TableSpec& t : scene_tables())
    text += fmt::format("\n## [{}]\n\n{}\n\n{}", t.name, cell(t.doc), key_rows(t.name));
  return text;
}

}  // namespace ddem::harness
