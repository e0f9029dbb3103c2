#pragma once
// Meshes of strips as data, which tests change and write; and what any mesh of a strip fulfils.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "meshes/strip_mesh.h"
#include "meshes/user_mesh.h"

namespace ddem::test {

struct TestMesh {
  using Tag = int;
  struct Line {
    Tag a, b;
    int group;
  };
  struct Quad {
    std::array<Tag, 4> corners;
    int surface = 1;
  };
  std::map<Tag, std::array<double, 3>> nodes;
  std::vector<Quad> quads;
  std::vector<Line> lines;
  std::map<int, std::string> names{{7, "left"}, {9, "right"}, {3, "bottom"}, {4, "top"}};  ///< of groups
  int nx = 0, ny = 0;

  Tag node(int i, int j) const { return 1 + i * (ny + 1) + j; }
  std::array<double, 3>& at(int i, int j) { return nodes.at(node(i, j)); }
  Quad& quad(int i, int j) { return quads.at(static_cast<std::size_t>(i * ny + j)); }
};

inline const meshes::StripSpec test_strip{0.01, 0.002, false}, periodic_test_strip{0.01, 0.002, true};

/// nx * ny quadrilaterals with bent inner lines.
inline TestMesh strip_mesh(int nx, int ny, double bend = 0.2) {
  TestMesh m;
  m.nx = nx;
  m.ny = ny;
  for (int i = 0; i <= nx; ++i) {
    for (int j = 0; j <= ny; ++j) {
      const bool inside = i % nx != 0 && j % ny != 0;
      const double dx = inside ? bend * std::sin(1.9 * i + 3.1 * j) : 0.0, dy = inside ? bend * std::cos(2.3 * i - 0.7 * j) : 0.0;
      m.nodes[m.node(i, j)] = {test_strip.length * (i + dx) / nx, test_strip.width * (j + dy) / ny, 0.0};
    }
  }
  for (int i = 0; i < nx; ++i) {
    for (int j = 0; j < ny; ++j) m.quads.push_back({{m.node(i, j), m.node(i + 1, j), m.node(i + 1, j + 1), m.node(i, j + 1)}});
  }
  for (int j = 0; j < ny; ++j) m.lines.push_back({m.node(0, j), m.node(0, j + 1), 7});
  for (int j = 0; j < ny; ++j) m.lines.push_back({m.node(nx, j), m.node(nx, j + 1), 9});
  for (int i = 0; i < nx; ++i) m.lines.push_back({m.node(i, 0), m.node(i + 1, 0), 3});
  for (int i = 0; i < nx; ++i) m.lines.push_back({m.node(i, ny), m.node(i + 1, ny), 4});
  return m;
}

/// In format 2.2; lines first: element numbers count from 1.
inline std::string msh_text(const TestMesh& m) {
  std::string text = fmt::format("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{}\n", m.names.size());
  for (const auto& [group, name] : m.names) text += fmt::format("1 {} \"{}\"\n", group, name);
  text += fmt::format("$EndPhysicalNames\n$Nodes\n{}\n", m.nodes.size());
  for (const auto& [tag, p] : m.nodes) text += fmt::format("{} {:.17g} {:.17g} {:.17g}\n", tag, p[0], p[1], p[2]);
  text += fmt::format("$EndNodes\n$Elements\n{}\n", m.lines.size() + m.quads.size());
  int number = 0;
  for (const auto& l : m.lines) text += fmt::format("{} 1 2 {} {} {} {}\n", ++number, l.group, l.group, l.a, l.b);
  for (const auto& q : m.quads) text += fmt::format("{} 3 2 20 {} {}\n", ++number, q.surface, fmt::join(q.corners, " "));
  return text + "$EndElements\n";
}

/// What a mesh of the strip is, found another way than the reader does: shapes by sampled Jacobians, the outline by lengths.
inline bool is_mesh_of(const meshes::QuadMesh& m, const meshes::StripSpec& strip) {
  double area = 0.0;
  std::map<std::array<unsigned, 2>, int> uses;
  for (const auto& q : m.quads) {
    std::array<std::array<double, 2>, 4> p{};
    for (int k = 0; k < 4; ++k) p[k] = m.vertices.at(q[k]);
    for (const double s : {0.0, 1.0}) {
      for (const double t : {0.0, 1.0}) {
        std::array<double, 2> along{}, across{};
        for (int c = 0; c < 2; ++c) {
          along[c] = (1 - t) * (p[1][c] - p[0][c]) + t * (p[2][c] - p[3][c]);
          across[c] = (1 - s) * (p[3][c] - p[0][c]) + s * (p[2][c] - p[1][c]);
        }
        const double jacobian = along[0] * across[1] - along[1] * across[0];
        if (!(jacobian > 0.0)) return false;
        area += 0.25 * jacobian;
      }
    }
    for (int k = 0; k < 4; ++k) ++uses[{std::min(q[k], q[(k + 1) % 4]), std::max(q[k], q[(k + 1) % 4])}];
  }
  if (!(std::abs(area / (strip.length * strip.width) - 1.0) < 1e-5)) return false;
  std::map<unsigned, double> length;
  std::map<unsigned, std::vector<double>> x;
  for (const auto& [ends, id] : m.edges) {
    const auto &a = m.vertices[ends[0]], &b = m.vertices[ends[1]];
    const auto found = uses.find({std::min(ends[0], ends[1]), std::max(ends[0], ends[1])});
    if (found == uses.end() || found->second != 1) return false;
    found->second = 2;  // once
    const bool upright = id == meshes::left_id || id == meshes::right_id;
    const double side = id == meshes::left_id || id == meshes::bottom_id ? 0.0 : upright ? m.length : m.width;
    if (a[upright ? 0 : 1] != side || b[upright ? 0 : 1] != side) return false;
    length[id] += std::hypot(a[0] - b[0], a[1] - b[1]);
    for (const auto& v : {a, b}) x[id].push_back(v[0]);
  }
  for (auto& [id, places] : x) std::sort(places.begin(), places.end());
  const auto matches = [](double a, double b) { return std::abs(a / b - 1.0) < 1e-5; };
  return std::all_of(uses.begin(), uses.end(), [](const auto& use) { return use.second == 2; }) &&
         matches(length[meshes::left_id], strip.width) && matches(length[meshes::right_id], strip.width) &&
         matches(length[meshes::bottom_id], strip.length) && matches(length[meshes::top_id], strip.length) &&
         (!strip.periodic || x[meshes::bottom_id] == x[meshes::top_id]);
}

}  // namespace ddem::test
