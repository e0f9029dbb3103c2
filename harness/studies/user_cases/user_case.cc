#include "harness/studies/user_cases/user_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "harness/io/digest.h"
#include "harness/model/memory_need.h"
#include "harness/scene/scene_files.h"

namespace ddem::harness {

std::optional<std::string> group_of(const std::string& metric) {
  const std::size_t dot = metric.find('.');
  if (dot == std::string::npos) return "";
  const std::string prefix = metric.substr(0, dot);
  for (const char* known : {"static", "fem", "stability"}) {
    if (prefix == known) return prefix;
  }
  return std::nullopt;
}

std::set<std::string> groups_of(const UserCase& c) {
  std::set<std::string> groups;
  for (const CaseCriterion& criterion : c.criteria) {
    groups.insert(group_of(criterion.metric).value());
    if (!criterion.reference.empty()) groups.insert(group_of(criterion.reference).value());
  }
  return groups;
}

SceneResult scene_of_case(const UserCase& c) {
  const std::set<std::string> groups = groups_of(c);
  // What ddem fem, run, moduli and stability read a scene for.
  const bool continuum = groups == std::set<std::string>{"fem"}, moves = groups.contains("") || groups.contains("fem");
  const ReadOptions options{continuum ? Purpose::continuum : moves ? Purpose::simulation : Purpose::statics, c.overrides, groups.contains("fem")};
  return parse_scene(c.text, c.scene, std::filesystem::path(c.scene).parent_path(), options);
}

std::string inputs_of_case(const UserCase& c) {
  std::string inputs = c.text;
  for (const SceneOverride& o : c.overrides) inputs += fmt::format("\n{} = {}", o.key, o.value);
  for (const std::string& group : groups_of(c)) inputs += "\n" + group;
  const SceneResult scene = scene_of_case(c);
  if (!scene) return inputs;
  for (const std::filesystem::path& file : files_named_by(*scene)) {
    std::error_code ignored;
    inputs += "\n" + (std::filesystem::exists(file, ignored) ? sha256_of_file(file) : "no file");
  }
  return inputs;
}

double memory_of_case(const UserCase& c) {
  const SceneResult scene = scene_of_case(c);
  if (!scene) return 0.0;
  const std::optional<double> discs = planned_discs(*scene);
  const std::set<std::string> groups = groups_of(c);
  double most = 0.0;
  for (const auto& [group, work] : {std::pair("", DiscWork::limits), std::pair("static", DiscWork::statics), std::pair("stability", DiscWork::limits)}) {
    if (discs && groups.contains(group)) most = std::max(most, memory_of_discs(*scene, *discs, work).bytes);
  }
  return most;
}

}  // namespace ddem::harness
