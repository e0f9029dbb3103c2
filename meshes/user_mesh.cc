#include "meshes/user_mesh.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>

#include "meshes/gmsh_session.h"
#include "meshes/strip_mesh.h"

namespace ddem::meshes {
namespace {

constexpr std::pair<const char*, unsigned> edge_names[] = {
    {"left", left_id}, {"right", right_id}, {"bottom", bottom_id}, {"top", top_id}};

using Tag = std::size_t;

// Corners of all elements of one entity that have `corners` of them; MeshError for others.
std::vector<Tag> corner_nodes(int dimension, int entity, int corners, const char* wanted) {
  std::vector<int> types;
  std::vector<std::vector<Tag>> elements, nodes;
  gmsh::model::mesh::getElements(types, elements, nodes, dimension, entity);
  std::vector<Tag> result;
  for (std::size_t k = 0; k < types.size(); ++k) {
    std::string name;
    int element_dimension = 0, order = 0, count = 0, primary = 0;
    std::vector<double> places;
    gmsh::model::mesh::getElementProperties(types[k], name, element_dimension, order, count, places, primary);
    if (primary != corners) throw MeshError("holds elements \"" + name + "\": a mesh must consist of " + wanted);
    for (std::size_t e = 0; e < elements[k].size(); ++e) {
      const auto first = nodes[k].begin() + static_cast<std::ptrdiff_t>(e * static_cast<std::size_t>(count));
      result.insert(result.end(), first, first + corners);
    }
  }
  return result;
}

class Reader {
 public:
  Reader() {
    std::vector<Tag> tags;
    std::vector<double> coordinates, parameters;
    gmsh::model::mesh::getNodes(tags, coordinates, parameters);
    for (std::size_t k = 0; k < tags.size(); ++k) {
      place_[tags[k]] = {coordinates[3 * k], coordinates[3 * k + 1], coordinates[3 * k + 2]};
    }
  }

  QuadMesh read() {
    const std::vector<Tag> corners = corner_nodes(2, -1, 4, "quadrilaterals");
    if (corners.empty()) throw MeshError("holds no quadrilaterals");
    for (std::size_t k = 0; k < corners.size(); k += 4) add_quad(&corners[k]);
    for (const auto& [name, id] : edge_names) add_edges(name, id);
    return std::move(mesh_);
  }

 private:
  unsigned vertex(Tag tag) {
    const auto [entry, fresh] = number_.try_emplace(tag, static_cast<unsigned>(mesh_.vertices.size()));
    if (fresh) {
      const std::array<double, 3>& p = place_.at(tag);
      if (p[2] != 0.0) throw MeshError("is not plane: a node has z = " + std::to_string(p[2]));
      mesh_.vertices.push_back({p[0], p[1]});
    }
    return entry->second;
  }

  void add_quad(const Tag* tags) {
    std::array<unsigned, 4> quad{vertex(tags[0]), vertex(tags[1]), vertex(tags[2]), vertex(tags[3])};
    const auto &a = mesh_.vertices[quad[0]], &b = mesh_.vertices[quad[1]], &c = mesh_.vertices[quad[2]];
    if ((b[0] - a[0]) * (c[1] - b[1]) < (b[1] - a[1]) * (c[0] - b[0])) std::swap(quad[1], quad[3]);
    mesh_.quads.push_back(quad);
  }

  void add_edges(const std::string& name, unsigned id) {
    gmsh::vectorpair groups;
    gmsh::model::getPhysicalGroups(groups, 1);
    std::size_t found = 0;
    for (const auto& [dimension, tag] : groups) {
      std::string group;
      gmsh::model::getPhysicalName(dimension, tag, group);
      if (group != name) continue;
      std::vector<int> entities;
      gmsh::model::getEntitiesForPhysicalGroup(dimension, tag, entities);
      for (const int entity : entities) {
        const std::vector<Tag> ends = corner_nodes(1, entity, 2, "lines");
        for (std::size_t k = 0; k < ends.size(); k += 2, ++found) {
          if (!number_.contains(ends[k]) || !number_.contains(ends[k + 1])) throw MeshError("\"" + name + "\" is no edge of its quadrilaterals");
          mesh_.edges.push_back({{vertex(ends[k]), vertex(ends[k + 1])}, id});
        }
      }
    }
    if (found == 0) throw MeshError("has no physical curve \"" + name + "\"; it must name left, right, bottom and top");
  }

  std::map<Tag, std::array<double, 3>> place_;
  std::map<Tag, unsigned> number_;
  QuadMesh mesh_;
};

}  // namespace

QuadMesh read_user_mesh(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file)) throw MeshError("is no file");
  return with_gmsh<MeshError>([&] {
    gmsh::open(file.string());
    return Reader().read();
  });
}

}  // namespace ddem::meshes
