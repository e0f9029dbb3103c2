#include "harness/scene/place.h"

#include <utility>

#include "harness/scene/violation.h"

namespace ddem::harness {

std::string scene_problem(const Scene& scene, std::string_view dotted_key, std::string message, std::string remedy) {
  Violation v{scene.path.string(), 0, 0, std::string(dotted_key), "", std::move(message), std::move(remedy)};
  if (const auto place = scene.places.find(v.key); place != scene.places.end()) {
    v.line = place->second.line;
    v.value = place->second.text;
  }
  return to_string(v);
}

}  // namespace ddem::harness
