#include "meshes/quad_shapes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

namespace ddem::meshes {
namespace {

// The sine of the sharpest angle between the sides of an element at a corner: near 0 or 180 degrees its map is singular.
constexpr double smallest_sine = 1e-3;

enum class Shape { counterclockwise, clockwise, crossed, bent, flat };

Shape shape_of(const QuadMesh& mesh, const std::array<unsigned, 4>& quad) {
  int positive = 0;
  double sharpest = 1.0;
  for (int k = 0; k < 4; ++k) {
    const auto &a = mesh.vertices[quad[k]], &b = mesh.vertices[quad[(k + 1) % 4]], &c = mesh.vertices[quad[(k + 2) % 4]];
    const double ux = b[0] - a[0], uy = b[1] - a[1], vx = c[0] - b[0], vy = c[1] - b[1];
    const double cross = ux * vy - uy * vx, product = std::hypot(ux, uy) * std::hypot(vx, vy);
    positive += cross > 0.0 ? 1 : 0;
    sharpest = product > 0.0 ? std::min(sharpest, std::abs(cross) / product) : 0.0;
  }
  if (sharpest < smallest_sine) return Shape::flat;
  if (positive == 2) return Shape::crossed;
  if (positive == 1 || positive == 3) return Shape::bent;
  return positive == 4 ? Shape::counterclockwise : Shape::clockwise;
}

std::string described(const MeshDraft& draft, std::size_t k) {
  const auto& q = draft.mesh.quads[k];
  return fmt::format("element {} at {}, {}, {}, {}", draft.quad_tags[k], draft.place(q[0]), draft.place(q[1]), draft.place(q[2]),
                     draft.place(q[3]));
}

void refuse_doubled(const MeshDraft& draft) {
  Findings findings;
  std::map<std::array<unsigned, 4>, std::size_t> known;
  for (std::size_t k = 0; k < draft.mesh.quads.size(); ++k) {
    std::array<unsigned, 4> corners = draft.mesh.quads[k];
    std::sort(corners.begin(), corners.end());
    if (std::adjacent_find(corners.begin(), corners.end()) != corners.end()) {
      findings.add("repeated", [&] { return described(draft, k) + " has a node twice"; });
    }
    const std::size_t first = known.try_emplace(corners, k).first->second;
    if (first == k) continue;
    findings.add("doubled", [&] {
      return fmt::format("elements {} and {} are one, at {} (format 2.2 lists an element once for each physical surface: use one, or format 4.1)",
                         draft.quad_tags[first], draft.quad_tags[k], draft.place(draft.mesh.quads[k][0]));
    });
  }
  findings.throw_if_any();
}

void find_nodes_at_one_place(const MeshDraft& draft, Findings& findings) {
  const auto& vertices = draft.mesh.vertices;
  const double tolerance = side_tolerance * draft.mesh.width;
  std::vector<unsigned> order(vertices.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](unsigned a, unsigned b) { return vertices[a] < vertices[b]; });
  // Columns of nodes, whose x differ by less than the tolerance from one to the next; along each of them by y.
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    for (end = begin + 1; end < order.size() && vertices[order[end]][0] - vertices[order[end - 1]][0] <= tolerance;) ++end;
    const auto first = order.begin() + static_cast<std::ptrdiff_t>(begin), last = order.begin() + static_cast<std::ptrdiff_t>(end);
    std::sort(first, last, [&](unsigned a, unsigned b) { return vertices[a][1] < vertices[b][1]; });
    for (auto a = first, b = first + 1; b < last; ++a, ++b) {
      if (std::hypot(vertices[*b][0] - vertices[*a][0], vertices[*b][1] - vertices[*a][1]) > tolerance) continue;
      findings.add("at one place", [&, low = std::min(*a, *b), high = std::max(*a, *b)] {
        return fmt::format("nodes {} and {} lie at one place, {}: the mesh is slit there; merge them (gmsh: Coherence Mesh)",
                           draft.node_tags[low], draft.node_tags[high], draft.place(low));
      });
    }
  }
}

}  // namespace

void check_quads(MeshDraft& draft) {
  refuse_doubled(draft);
  Findings findings;
  std::vector<Shape> shapes;
  std::map<std::int64_t, std::array<std::size_t, 2>> directions;  // of each surface: elements either way round
  for (const auto& quad : draft.mesh.quads) {
    shapes.push_back(shape_of(draft.mesh, quad));
    if (shapes.back() == Shape::counterclockwise) ++directions[draft.surfaces[shapes.size() - 1]][0];
    if (shapes.back() == Shape::clockwise) ++directions[draft.surfaces[shapes.size() - 1]][1];
  }
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    auto& quad = draft.mesh.quads[k];
    const auto& [counterclockwise, clockwise] = directions[draft.surfaces[k]];
    const bool rare_way = shapes[k] == (counterclockwise < clockwise ? Shape::counterclockwise : Shape::clockwise);
    const auto add = [&](const char* what) { findings.add(what, [&] { return described(draft, k) + what; }); };
    if (shapes[k] == Shape::crossed) add(" is crossed (a bow-tie): list its corners in order around it");
    if (shapes[k] == Shape::bent) add(" has a corner that turns inwards");
    if (shapes[k] == Shape::flat) add(" has two sides in one line, or a side without length");
    if (rare_way && counterclockwise * clockwise > 0) add(" is turned: its corners run the other way round than those of its surface's other elements");
    if (shapes[k] == Shape::clockwise) std::swap(quad[1], quad[3]);
  }
  find_nodes_at_one_place(draft, findings);
  findings.throw_if_any();
}

}  // namespace ddem::meshes
