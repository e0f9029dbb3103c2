#include "meshes/strip_mesh.h"

#include <gmsh.h>

#include <stdexcept>

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

}  // namespace

void write_strip_mesh(const StripGeometry& geometry, const std::filesystem::path& file) {
  with_gmsh<std::runtime_error>([&] {
    make_mesh(geometry);
    gmsh::write(file.string());
  });
}

}  // namespace ddem::meshes
