#include "harness/scene/read_scene.h"

#include <algorithm>
#include <utility>

#include "harness/scene/build_scene.h"
#include "harness/scene/text_file.h"

namespace ddem::harness {
namespace {

Violations by_line(Violations violations) {
  std::stable_sort(violations.begin(), violations.end(), [](const Violation& a, const Violation& b) {
    return std::pair(a.line, a.column) < std::pair(b.line, b.column);
  });
  return violations;
}

void apply(Document& document, const SceneOverride& change) {
  const Checked<Document> value = parse_document("value = " + change.value, "value");
  const std::size_t dot = change.key.find('.');
  const std::string table = dot == std::string::npos ? "" : change.key.substr(0, dot), key = change.key.substr(dot + 1);
  Node node = value && value->entries.size() == 1 ? value->entries.front().node : Node{};
  node.text = change.value;
  const auto at = [&](const Entry& e) { return e.table == table && e.key == key; };
  if (const auto found = std::find_if(document.entries.begin(), document.entries.end(), at); found != document.entries.end()) {
    node.line = found->node.line;
    found->node = std::move(node);
    return;
  }
  node.line = 0;
  const bool known = std::any_of(document.tables.begin(), document.tables.end(), [&](const TableHeader& t) { return t.name == table; });
  if (!known && !table.empty()) document.tables.push_back({table, 0, 0});
  document.entries.push_back({table, key, std::move(node)});
}

IsRead files_read_for(const ReadOptions& options) {
  return [&options](std::string_view dotted) {
    if (dotted == "continuum.mesh") return options.purpose == Purpose::continuum || options.continuum_too;
    return options.purpose == Purpose::simulation || !dotted.starts_with("initial.");
  };
}

}  // namespace

SceneResult parse_scene(std::string_view text, const std::string& name,
                        const std::filesystem::path& base_folder, const ReadOptions& options) {
  Checked<Document> document = parse_document(text, name);
  if (!document) return document.violations;
  for (const SceneOverride& change : options.overrides) apply(*document.value, change);
  Values values(*document, name, base_folder, files_read_for(options));
  if (!values.too_many_violations()) check_scene(values, options.purpose);
  if (!values.violations().empty()) {
    Violations violations = by_line(values.violations());
    if (values.too_many_violations()) {
      violations.push_back(
          {name, 0, 0, "", "", "so many problems that the rest was not looked at", "is it a scene?"});
    }
    return violations;
  }
  Scene scene = build_scene(values);
  scene.path = name;
  scene.source_text = text;
  for (const Entry& entry : document->entries) {
    scene.places[dotted_name(entry.table, entry.key)] = {entry.node.line, entry.node.text};
  }
  return scene;
}

SceneResult read_scene(const std::filesystem::path& path, const ReadOptions& options) {
  // Room for a hundred thousand probes, and a bound for what rubbish costs: parsing takes about 90 bytes of
  // memory and 0.2 microseconds a byte.
  constexpr std::size_t max_bytes = std::size_t{4} << 20;
  const Checked<std::string> text = read_text_file(path, max_bytes, Pipes::taken);
  if (!text) return text.violations;
  return parse_scene(*text, path.string(), path.parent_path(), options);
}

}  // namespace ddem::harness
