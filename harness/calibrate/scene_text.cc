#include "harness/calibrate/scene_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "harness/io/errors.h"
#include "harness/scene/document.h"
#include "harness/scene/read_scene.h"

namespace ddem::harness {
namespace {

struct NewValue {
  std::string table, key;
  double value = 0.0;
};

std::vector<NewValue> new_values(const Scene& scene, const FoundParameters& found) {
  const bool modulus = scene.contact && std::holds_alternative<ContactModulus>(scene.contact->stiffness);
  std::vector<NewValue> values = {
      {"contact", modulus ? "contact_modulus" : "normal_stiffness", found.stiffness},
      {"contact", "stiffness_ratio", found.point.stiffness_ratio}};
  if (found.particle_density) values.push_back({"material", "density", *found.particle_density});
  if (scene.deformation) {
    values.push_back({"deformation", "young_modulus", found.particle_young_modulus});
    values.push_back({"deformation", "poisson_ratio", found.point.particle_poisson_ratio});
  }
  return values;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines(1);
  for (const char c : text) {
    if (c == '\n') {
      lines.emplace_back();
    } else {
      lines.back() += c;
    }
  }
  if (lines.back().empty()) lines.pop_back();
  return lines;
}

/// TOML needs a point or an exponent in a float; the shortest text that reads back to the same bits.
std::string number_text(double value) {
  std::string text = fmt::format("{}", value);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

/// The value behind the key on its line; false where it cannot be found there.
bool replace_value(std::string& line, const std::string& key, const std::string& old_text,
                   const std::string& new_text) {
  const auto name = line.find(key);
  if (name == std::string::npos) return false;
  const auto at = line.find(old_text, name + key.size());
  if (at == std::string::npos) return false;
  line.replace(at, old_text.size(), new_text);
  return true;
}

int header_line(const Document& document, const std::string& table) {
  for (const TableHeader& t : document.tables) {
    if (t.name == table) return t.line;
  }
  return 0;
}

bool reads_back(const Scene& scene, const std::string& text, const std::vector<NewValue>& values) {
  const auto document = parse_document(text, scene.path.string());
  if (!document || !parse_scene(text, scene.path.string(), scene.path.parent_path(), {Purpose::statics}))
    return false;
  for (const NewValue& v : values) {
    bool found = false;
    for (const Entry& e : document->entries) {
      const auto* number = std::get_if<double>(&e.node.value);
      found = found || (e.table == v.table && e.key == v.key && number != nullptr && *number == v.value);
    }
    if (!found) return false;
  }
  return true;
}

}  // namespace

std::string default_load_text(double shear_speed) {
  return fmt::format(R"(
[drive]                          # a shear pulse of 8 mm; longitudinal, and half as long a duration, for P
wave      = "shear"
shape     = "sin2"
duration  = {}
amplitude = "10 nm"

[probes]
pairs   = 5
section = true
)",
                     8e-3 / shear_speed);
}

std::string default_assembly_text() {
  return R"(title = "calibrated strip"

[assembly]
packing      = "random"
length       = "16.5 mm"
width        = "2 mm"
discs        = 682
coordination = 5.8
seed         = 1                  # another seed is another packing of the same kind

[boundary]
top_bottom = "periodic"
right      = "fixed_x"
)";
}

std::string calibrated_text(const Scene& scene, const FoundParameters& found) {
  const std::vector<NewValue> values = new_values(scene, found);
  const auto document = parse_document(scene.source_text, scene.path.string());
  std::vector<std::string> lines = lines_of(scene.source_text);
  std::vector<std::pair<std::string, std::string>> appended;  // tables that are not there
  std::vector<std::pair<int, std::string>>
      inserted;  // behind a table's header, from below so that line numbers hold
  for (const NewValue& v : values) {
    const std::string text = number_text(v.value), row = fmt::format("{} = {}", v.key, text);
    const auto place = scene.places.find(v.table + "." + v.key);
    if (place != scene.places.end()) {
      replace_value(lines[place->second.line - 1], v.key, place->second.text, text);
    } else if (const int line = header_line(*document, v.table); line > 0) {
      inserted.emplace_back(line, row);
    } else {
      appended.emplace_back(v.table, row);
    }
  }
  std::stable_sort(inserted.begin(), inserted.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  for (const auto& [line, row] : inserted) lines.insert(lines.begin() + line, row);
  std::string last_table;
  for (const auto& [table, row] : appended) {
    if (table != last_table) lines.insert(lines.end(), {"", fmt::format("[{}]", table)});
    last_table = table;
    lines.push_back(row);
  }
  std::string out;
  for (const std::string& line : lines) out += line + "\n";
  if (!reads_back(scene, out, values)) {
    throw InputError(
        fmt::format("{}: the found values cannot be put into this file; write [contact], [material] and "
                    "[deformation] as tables "
                    "with a line for each key",
                    scene.path.string()));
  }
  return out;
}

}  // namespace ddem::harness
