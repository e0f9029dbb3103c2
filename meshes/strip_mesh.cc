#include "meshes/strip_mesh.h"

#include <gmsh.h>

#include <stdexcept>
#include <string>

namespace ddem::meshes {
namespace {

// gmsh as long as it is needed: no user's configuration, no output, signals and exit left to the program.
class Session {
 public:
  Session() {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.AbortOnError", 2);
    gmsh::option::setNumber("Mesh.MshFileVersion", 4.1);
    gmsh::option::setNumber("Mesh.Binary", 0);
  }
  ~Session() { gmsh::finalize(); }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
};

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
  try {
    const Session session;
    make_mesh(geometry);
    gmsh::write(file.string());
  } catch (const std::exception& error) {
    throw std::runtime_error(std::string("gmsh: ") + error.what());
  } catch (const std::string& reason) {  // older interfaces throw strings
    throw std::runtime_error("gmsh: " + reason);
  } catch (int code) {
    throw std::runtime_error("gmsh failed with code " + std::to_string(code));
  }
}

}  // namespace ddem::meshes
