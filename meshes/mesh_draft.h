#pragma once
// A mesh while it is checked: elements and nodes by number, with what the file calls them; and what was found to be wrong.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "meshes/mesh_error.h"
#include "meshes/user_mesh.h"

namespace ddem::meshes {

using Edge = std::array<unsigned, 2>;

struct MeshDraft {
  QuadMesh mesh;
  std::array<double, 2> origin{};  ///< the lower left corner in the file's coordinates
  std::vector<std::uint64_t> node_tags, quad_tags;
  std::vector<std::int64_t> surfaces;  ///< of each quadrilateral

  /// As the file has it.
  std::string place(unsigned vertex) const {
    const auto& v = mesh.vertices[vertex];
    return fmt::format("({:.6g}, {:.6g})", v[0] + origin[0], v[1] + origin[1]);
  }
  std::string edge(const Edge& ends) const { return fmt::format("from {} to {}", place(ends[0]), place(ends[1])); }
};

/// Of each kind of problem the first, and how many more there are.
class Findings {
 public:
  /// `message` is called for the first of its kind: its text without a full stop.
  template <typename Message>
  void add(const std::string& kind, const Message& message) {
    const auto [entry, first] = number_.try_emplace(kind, found_.size());
    if (first) {
      found_.emplace_back(message(), 0);
    } else {
      ++found_[entry->second].second;
    }
  }

  std::string text(const char* separator) const {
    std::vector<std::string> parts;
    for (const auto& [message, more] : found_) parts.push_back(more == 0 ? message : fmt::format("{} (and {} more)", message, more));
    return fmt::format("{}", fmt::join(parts, separator));
  }

  void throw_if_any(const char* separator = "\n") const {
    if (!found_.empty()) throw MeshError(text(separator));
  }

 private:
  std::map<std::string, std::size_t> number_;
  std::vector<std::pair<std::string, std::size_t>> found_;
};

}  // namespace ddem::meshes
