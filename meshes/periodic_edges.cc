#include "meshes/periodic_edges.h"

#include <algorithm>
#include <cmath>

#include "meshes/quad_mesh.h"

namespace ddem::meshes {
namespace {

// Along x.
std::vector<unsigned> nodes_of_side(const QuadMesh& mesh, unsigned id) {
  std::vector<unsigned> nodes;
  for (const auto& [ends, side] : mesh.edges) {
    if (side == id) nodes.insert(nodes.end(), ends.begin(), ends.end());
  }
  std::sort(nodes.begin(), nodes.end(), [&](unsigned a, unsigned b) { return mesh.vertices[a] < mesh.vertices[b]; });
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

double shortest_edge_at(const QuadMesh& mesh, const std::vector<unsigned>& nodes, std::size_t k) {
  const auto gap = [&](std::size_t right) { return mesh.vertices[nodes[right]][0] - mesh.vertices[nodes[right - 1]][0]; };
  return std::min(gap(std::max<std::size_t>(k, 1)), gap(std::min(k + 1, nodes.size() - 1)));
}

std::size_t nearest(const QuadMesh& mesh, const std::vector<unsigned>& nodes, double x) {
  const auto right = std::lower_bound(nodes.begin(), nodes.end(), x, [&](unsigned node, double value) { return mesh.vertices[node][0] < value; });
  const auto k = static_cast<std::size_t>(right - nodes.begin());
  if (k == 0) return 0;
  if (k == nodes.size()) return k - 1;
  return x - mesh.vertices[nodes[k - 1]][0] < mesh.vertices[nodes[k]][0] - x ? k - 1 : k;
}

}  // namespace

void match_periodic_edges(MeshDraft& draft) {
  QuadMesh& mesh = draft.mesh;
  const std::vector<unsigned> bottom = nodes_of_side(mesh, bottom_id), top = nodes_of_side(mesh, top_id);
  const auto refuse_lonely = [&](const std::vector<unsigned>& nodes, const std::vector<unsigned>& others, const char* other) {
    Findings findings;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const double x = mesh.vertices[nodes[k]][0];
      const unsigned partner = others[nearest(mesh, others, x)];
      if (std::abs(mesh.vertices[partner][0] - x) <= partner_tolerance * shortest_edge_at(mesh, nodes, k)) continue;
      findings.add("", [&] {
        return fmt::format("node {} at {} has no partner at the same x on the {}, which is periodic: the nearest is node {} at {} (gmsh: Periodic Curve)",
                           draft.node_tags[nodes[k]], draft.place(nodes[k]), other, draft.node_tags[partner], draft.place(partner));
      });
    }
    findings.throw_if_any();
  };
  refuse_lonely(top, bottom, "bottom");
  refuse_lonely(bottom, top, "top");
  for (std::size_t k = 0; k < top.size(); ++k) mesh.vertices[top[k]][0] = mesh.vertices[bottom[k]][0];
}

}  // namespace ddem::meshes
