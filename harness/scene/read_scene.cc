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

}  // namespace

SceneResult parse_scene(std::string_view text, const std::string& name,
                        const std::filesystem::path& base_folder, const ReadOptions& options) {
  const Checked<Document> document = parse_document(text, name);
  if (!document) return document.violations;
  Values values(*document, name, base_folder);
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
  const Checked<std::string> text = read_text_file(path, max_bytes);
  if (!text) return text.violations;
  return parse_scene(*text, path.string(), path.parent_path(), options);
}

}  // namespace ddem::harness
