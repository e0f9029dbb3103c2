#include "meshes/strip_mesh.h"

#include <gmsh.h>

#include <map>
#include <stdexcept>
#include <vector>

#include "meshes/gmsh_session.h"

namespace ddem::meshes {
namespace {

void make_mesh(const StripGeometry& g) {
  gmsh::model::add("strip");
  namespace geo = gmsh::model::geo;
  const int corners[] = {geo::addPoint(0, 0, 0), geo::addPoint(g.length, 0, 0),
                         geo::addPoint(g.length, g.width, 0), geo::addPoint(0, g.width, 0)};
  const int bottom = geo::addLine(corners[0], corners[1]), right = geo::addLine(corners[1], corners[2]);
  const int top = geo::addLine(corners[2], corners[3]), left = geo::addLine(corners[3], corners[0]);
  const int surface = geo::addPlaneSurface({geo::addCurveLoop({bottom, right, top, left})});
  for (const int curve : {bottom, top}) geo::mesh::setTransfiniteCurve(curve, static_cast<int>(g.nx) + 1);
  for (const int curve : {left, right}) geo::mesh::setTransfiniteCurve(curve, static_cast<int>(g.ny) + 1);
  geo::mesh::setTransfiniteSurface(surface);
  geo::mesh::setRecombine(2, surface);
  geo::synchronize();
  gmsh::model::addPhysicalGroup(1, {left}, left_id);
  gmsh::model::addPhysicalGroup(1, {right}, right_id);
  gmsh::model::addPhysicalGroup(1, {bottom}, bottom_id);
  gmsh::model::addPhysicalGroup(1, {top}, top_id);
  gmsh::model::addPhysicalGroup(2, {surface}, 1);
  gmsh::model::mesh::generate(2);
}

constexpr int kLine = 1, kQuad = 3;  // gmsh's types of elements

/// Tags of the corners of an entity's elements of a type (of all entities: -1), one element after the other.
std::vector<std::size_t> corners_of(int type, int entity) {
  std::vector<std::size_t> elements, corners;
  gmsh::model::mesh::getElementsByType(type, elements, corners, entity);
  return corners;
}

QuadMesh read_model(const StripGeometry& g) {
  QuadMesh mesh;
  mesh.length = g.length, mesh.width = g.width;
  std::vector<std::size_t> tags;
  std::vector<double> places, parameters;
  gmsh::model::mesh::getNodes(tags, places, parameters);
  std::map<std::size_t, unsigned> vertex_of;
  for (std::size_t n = 0; n < tags.size(); ++n) {
    vertex_of[tags[n]] = static_cast<unsigned>(n);
    mesh.vertices.push_back({places[3 * n], places[3 * n + 1]});
  }
  for (const unsigned id : {left_id, right_id, bottom_id, top_id}) {
    std::vector<int> curves;
    gmsh::model::getEntitiesForPhysicalGroup(1, static_cast<int>(id), curves);
    for (const int curve : curves) {
      const auto c = corners_of(kLine, curve);
      for (std::size_t k = 0; k < c.size(); k += 2) mesh.edges.push_back({{vertex_of.at(c[k]), vertex_of.at(c[k + 1])}, id});
    }
  }
  const auto c = corners_of(kQuad, -1);
  for (std::size_t k = 0; k < c.size(); k += 4) mesh.quads.push_back({vertex_of.at(c[k]), vertex_of.at(c[k + 1]), vertex_of.at(c[k + 2]), vertex_of.at(c[k + 3])});
  return mesh;
}

}  // namespace

QuadMesh strip_mesh(const StripGeometry& geometry) {
  return with_gmsh<std::runtime_error>([&] {
    make_mesh(geometry);
    return read_model(geometry);
  });
}

}  // namespace ddem::meshes
