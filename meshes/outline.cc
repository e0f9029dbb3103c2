#include "meshes/outline.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include "meshes/msh_source.h"
#include "meshes/quad_mesh.h"

namespace ddem::meshes {
namespace {

constexpr unsigned side_count = 4;
constexpr const char* side_names[] = {"left", "right", "bottom", "top"};
constexpr unsigned side_ids[] = {left_id, right_id, bottom_id, top_id};
constexpr unsigned no_side = side_count;

struct EdgeUse {
  unsigned elements = 0;
  std::size_t first = 0;  ///< of the elements
  bool forward = false;   ///< that one runs from the edge's lower vertex to the higher
  unsigned side = no_side;
  unsigned names = 0;     ///< bits by the number of the side
};
using Edges = std::map<Edge, EdgeUse>;

Edge sorted(unsigned a, unsigned b) {
  return {std::min(a, b), std::max(a, b)};
}

std::string element_of(const MeshDraft& draft, const Edge& edge, const EdgeUse& use) {
  return fmt::format("the edge {} of element {}", draft.edge(edge), draft.quad_tags[use.first]);
}

unsigned sides_of(const QuadMesh& mesh, unsigned vertex) {
  const auto& [x, y] = mesh.vertices[vertex];
  return (x == 0.0 ? 1U : 0U) | (x == mesh.length ? 2U : 0U) | (y == 0.0 ? 4U : 0U) | (y == mesh.width ? 8U : 0U);
}

Edges collect_edges(const MeshDraft& draft) {
  Edges edges;
  Findings findings;
  const QuadMesh& mesh = draft.mesh;
  for (std::size_t k = 0; k < mesh.quads.size(); ++k) {
    for (unsigned c = 0; c < 4; ++c) {
      const unsigned a = mesh.quads[k][c], b = mesh.quads[k][(c + 1) % 4];
      const Edge edge = sorted(a, b);
      EdgeUse& use = edges[edge];
      if (use.elements > 0 && (use.elements > 1 || use.forward == (a < b))) {
        findings.add("overlap", [&] { return fmt::format("element {} overlaps others at {}", draft.quad_tags[k], element_of(draft, edge, use)); });
      }
      if (use.elements++ > 0) continue;
      use.first = k;
      use.forward = a < b;
      const unsigned common = sides_of(mesh, a) & sides_of(mesh, b);
      for (unsigned side = 0; side < side_count; ++side) {
        if (common >> side & 1) use.side = side;
      }
    }
  }
  findings.throw_if_any();
  return edges;
}

// A vertex between the ends of an edge; the mesh's number of vertices if there is none.
unsigned vertex_on(const QuadMesh& mesh, const Edge& edge) {
  const auto &a = mesh.vertices[edge[0]], &b = mesh.vertices[edge[1]];
  const double dx = b[0] - a[0], dy = b[1] - a[1], square = dx * dx + dy * dy;
  unsigned v = 0;
  for (; v < mesh.vertices.size(); ++v) {
    const double x = mesh.vertices[v][0] - a[0], y = mesh.vertices[v][1] - a[1];
    const double along = (x * dx + y * dy) / square, off = (x * dy - y * dx) / square;
    if (std::abs(off) < side_tolerance && along > side_tolerance && along < 1.0 - side_tolerance) break;
  }
  return v;
}

// Edges of one element inside the rectangle: those on which nodes hang, or if there are none all.
void refuse_gaps(const MeshDraft& draft, const Edges& edges) {
  Findings hanging_nodes, gaps;
  int to_look_at = 1000;  // for nodes that hang on them, which takes a look at every node
  for (const auto& [edge, use] : edges) {
    if (use.elements > 1 || use.side != no_side) continue;
    const unsigned hanging = to_look_at-- > 0 ? vertex_on(draft.mesh, edge) : static_cast<unsigned>(draft.mesh.vertices.size());
    if (hanging < draft.mesh.vertices.size()) {
      hanging_nodes.add("", [&, &edge = edge, &use = use] {
        return fmt::format("node {} at {} hangs on {}: elements must share whole edges", draft.node_tags[hanging], draft.place(hanging),
                           element_of(draft, edge, use));
      });
    } else {
      gaps.add("", [&, &edge = edge, &use = use] {
        return fmt::format("{} lies on no side of the rectangle and belongs to no second element: a hole, a slit, or an outline that is no rectangle",
                           element_of(draft, edge, use));
      });
    }
  }
  hanging_nodes.throw_if_any();
  gaps.throw_if_any();
}

double area(const QuadMesh& mesh) {
  double sum = 0.0;
  for (const auto& q : mesh.quads) {
    const auto &a = mesh.vertices[q[0]], &b = mesh.vertices[q[1]], &c = mesh.vertices[q[2]], &d = mesh.vertices[q[3]];
    sum += 0.5 * ((c[0] - a[0]) * (d[1] - b[1]) - (d[0] - b[0]) * (c[1] - a[1]));
  }
  return sum;
}

// Names of the sides that a line carries, as bits.
unsigned names_of(const MshFile& file, std::int64_t curve) {
  const auto found = file.curve_names.find(curve);
  unsigned bits = 0;
  for (unsigned side = 0; side < side_count && found != file.curve_names.end(); ++side) {
    if (found->second.contains(side_names[side])) bits |= 1U << side;
  }
  return bits;
}

// Where a line of a physical curve lies that is not on that curve's side; empty where it is.
std::string wrong_place(const Edges& edges, const Edge& edge, unsigned side) {
  const auto found = edges.find(edge);
  if (found == edges.end()) return "is no edge of an element";
  if (found->second.elements > 1) return "lies inside the strip";
  return found->second.side == side ? "" : fmt::format("lies on the {} side", side_names[found->second.side]);
}

void require_names(const MshFile& file) {
  std::set<std::string> names;
  for (const MshFile::Line& line : file.lines) {
    const auto found = file.curve_names.find(line.curve);
    for (const std::string& name : found == file.curve_names.end() ? std::set<std::string>() : found->second) names.insert(printable(name));
  }
  Findings findings;
  for (const char* name : side_names) {
    if (names.contains(name)) continue;
    const std::string has = names.empty() ? "" : fmt::format("; it has {}", fmt::join(names, ", "));
    findings.add(name, [&] { return fmt::format("has no physical curve \"{}\": it must name left, right, bottom and top{}", name, has); });
  }
  findings.throw_if_any();
}

void check_names(const MeshDraft& draft, const MshFile& file, Edges& edges) {
  std::unordered_map<std::uint64_t, unsigned> vertex_of;
  for (unsigned v = 0; v < draft.node_tags.size(); ++v) vertex_of[draft.node_tags[v]] = v;
  Findings findings;
  for (const MshFile::Line& line : file.lines) {
    const unsigned names = names_of(file, line.curve);
    if (names == 0) continue;
    const auto a = vertex_of.find(line.ends[0]), b = vertex_of.find(line.ends[1]);
    if (a == vertex_of.end() || b == vertex_of.end()) {
      findings.add("loose", [&] { return fmt::format("line {} of a physical curve has a node that is no corner of an element", line.tag); });
      continue;
    }
    const Edge edge = sorted(a->second, b->second);
    for (unsigned side = 0; side < side_count; ++side) {
      if ((names >> side & 1) == 0) continue;
      const std::string wrong = wrong_place(edges, edge, side);
      if (wrong.empty() || wrong.starts_with("lies on")) edges[edge].names |= 1U << side;
      if (wrong.empty()) continue;
      findings.add(side_names[side] + wrong, [&] {
        return fmt::format("physical curve \"{}\" holds line {} {}, which {}", side_names[side], line.tag, draft.edge(edge), wrong);
      });
    }
  }
  for (const auto& [edge, use] : edges) {
    if (use.elements > 1 || use.names != 0) continue;
    findings.add(fmt::format("nameless {}", use.side), [&, &edge = edge, &use = use] {
      return fmt::format("{} on the {} side is in no physical curve \"{}\"", element_of(draft, edge, use), side_names[use.side], side_names[use.side]);
    });
  }
  findings.throw_if_any("; ");
}

}  // namespace

void check_outline(MeshDraft& draft, const MshFile& file) {
  Edges edges = collect_edges(draft);
  refuse_gaps(draft, edges);
  // Without gaps it is a whole number of times the rectangle's.
  const double covered = area(draft.mesh) / (draft.mesh.length * draft.mesh.width);
  if (std::abs(covered - 1.0) > 1e-6) throw MeshError(fmt::format("its elements cover {:.6g} times the area of the rectangle", covered));
  require_names(file);
  check_names(draft, file, edges);
  for (const auto& [edge, use] : edges) {
    if (use.elements == 1) draft.mesh.edges.emplace_back(edge, side_ids[use.side]);
  }
}

}  // namespace ddem::meshes
