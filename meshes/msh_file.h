#pragma once
// The .msh format of gmsh: nodes, lines and quadrilaterals of a plane mesh, and the names of its curves. A reader of our
// own, since gmsh's runs what it is given: any file that is no mesh as a script, and scripts that lie beside a mesh.

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "meshes/mesh_error.h"

namespace ddem::meshes {

/// Tags are the file's own numbers; elements of higher order are taken by their corners.
struct MshFile {
  using Tag = std::uint64_t;
  struct Line {
    Tag tag = 0;
    std::array<Tag, 2> ends{};
    std::int64_t curve = 0;
  };
  struct Quad {
    Tag tag = 0;
    std::array<Tag, 4> corners{};
    std::int64_t surface = 0;
  };
  std::map<Tag, std::array<double, 3>> nodes;  ///< places
  std::vector<Line> lines;
  std::vector<Quad> quads;
  std::map<std::int64_t, std::set<std::string>> curve_names;  ///< physical groups of each curve that has a name
};

/// Formats 2.2, 4 and 4.1, the last and 2.2 in bytes, too. Throws MeshError, naming the line, for all else: other formats,
/// what does not begin with $MeshFormat, damaged files, elements that are neither points, lines nor quadrilaterals.
MshFile parse_msh(std::string_view bytes);

}  // namespace ddem::meshes
