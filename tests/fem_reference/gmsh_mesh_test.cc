// Meshes as gmsh makes and writes them: read as gmsh reads them, and carrying waves as exact solutions do.

#include <gmsh.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <set>
#include <tuple>

#include "meshes/gmsh_session.h"
#include "meshes/msh_file.h"
#include "meshes/user_mesh.h"
#include "tests/fem_reference/case_builder.h"
#include "tests/fem_reference/dalembert.h"
#include "tests/fem_reference/program.h"

namespace ddem::fem {
namespace {

using test::bar_case;
using test::case_file;
using test::compare;
using test::Json;
using test::receiver_places;
using test::ReleasedPulse;
using test::shear_case;
using test::SignalsReader;
using test::strip_length;
using test::strip_width;
using test::Workplace;
namespace geo = gmsh::model::geo;

void name_curves(int left, int right, const std::vector<int>& bottom, const std::vector<int>& top) {
  const auto name = [](const std::vector<int>& curves, const char* text) {
    gmsh::model::setPhysicalName(1, gmsh::model::addPhysicalGroup(1, curves), text);
  };
  name({left}, "left");
  name({right}, "right");
  name(bottom, "bottom");
  name(top, "top");
}

// The usual rectangle: its loop runs left to right at the bottom, right to left at the top.
void rectangle(bool transfinite, bool periodic, int nx, int ny, double grading = 1.0) {
  const double size = strip_width / ny;
  const int p[] = {geo::addPoint(0, 0, 0, size), geo::addPoint(strip_length, 0, 0, size),
                   geo::addPoint(strip_length, strip_width, 0, size), geo::addPoint(0, strip_width, 0, size)};
  const int bottom = geo::addLine(p[0], p[1]), right = geo::addLine(p[1], p[2]), top = geo::addLine(p[2], p[3]), left = geo::addLine(p[3], p[0]);
  const int surface = geo::addPlaneSurface({geo::addCurveLoop({bottom, right, top, left})});
  if (transfinite) {
    geo::mesh::setTransfiniteCurve(bottom, nx + 1, "Progression", grading);
    geo::mesh::setTransfiniteCurve(top, nx + 1, "Progression", 1.0 / grading);
    for (const int curve : {left, right}) geo::mesh::setTransfiniteCurve(curve, ny + 1);
    geo::mesh::setTransfiniteSurface(surface);
  }
  geo::mesh::setRecombine(2, surface);
  geo::synchronize();
  name_curves(left, right, {bottom}, {top});
  gmsh::model::addPhysicalGroup(2, {surface});
  if (periodic) gmsh::model::mesh::setPeriodic(1, {top}, {bottom}, {1, 0, 0, 0, 0, 1, 0, strip_width, 0, 0, 1, 0, 0, 0, 0, 1});
  if (!transfinite) gmsh::option::setNumber("Mesh.RecombinationAlgorithm", 2);
  gmsh::model::mesh::generate(2);
}

// Two rectangles side by side, whose loops run opposite ways: the elements of one are clockwise.
void two_surfaces(int nx, int ny) {
  const double middle = strip_length / 3;
  const auto points = [&](double x) { return std::pair(geo::addPoint(x, 0, 0), geo::addPoint(x, strip_width, 0)); };
  const auto [a, b] = points(0);
  const auto [c, d] = points(middle);
  const auto [e, f] = points(strip_length);
  const int left = geo::addLine(a, b), inner = geo::addLine(c, d), right = geo::addLine(e, f);
  const int bottom[] = {geo::addLine(a, c), geo::addLine(c, e)}, top[] = {geo::addLine(b, d), geo::addLine(d, f)};
  const int surfaces[] = {geo::addPlaneSurface({geo::addCurveLoop({bottom[0], inner, -top[0], -left})}),
                          geo::addPlaneSurface({geo::addCurveLoop({inner, top[1], -right, -bottom[1]})})};
  for (const int curve : {left, inner, right}) geo::mesh::setTransfiniteCurve(curve, ny + 1);
  for (const int curve : {bottom[0], top[0]}) geo::mesh::setTransfiniteCurve(curve, nx / 3 + 1);
  for (const int curve : {bottom[1], top[1]}) geo::mesh::setTransfiniteCurve(curve, nx - nx / 3 + 1);
  for (const int surface : surfaces) {
    geo::mesh::setTransfiniteSurface(surface);
    geo::mesh::setRecombine(2, surface);
  }
  geo::synchronize();
  name_curves(left, right, {bottom[0], bottom[1]}, {top[0], top[1]});
  gmsh::model::addPhysicalGroup(2, {surfaces[0], surfaces[1]});
  gmsh::model::mesh::generate(2);
}

const std::pair<const char*, std::function<void()>> kinds[] = {
    {"transfinite", [] { rectangle(true, false, 33, 4); }},
    {"periodic", [] { rectangle(true, true, 33, 4); }},
    {"graded", [] { rectangle(true, false, 40, 4, 1.02); }},
    {"thin", [] { rectangle(true, false, 33, 1); }},
    {"unstructured", [] { rectangle(false, true, 33, 4); }},
    {"two surfaces", [] { two_surfaces(33, 4); }},
    {"second order", [] { rectangle(true, false, 33, 4), gmsh::model::mesh::setOrder(2); }},
};

struct Format {
  double version;
  bool bytes;
};
constexpr Format formats[] = {{2.2, false}, {2.2, true}, {4.0, false}, {4.1, false}, {4.1, true}};

void write(const std::function<void()>& make, const std::filesystem::path& file, Format format) {
  const meshes::GmshSession session;
  gmsh::model::add("strip");
  make();
  gmsh::option::setNumber("Mesh.MshFileVersion", format.version);
  gmsh::option::setNumber("Mesh.Binary", format.bytes);
  gmsh::write(file.string());
}

/// In 1e-12 m: later versions of gmsh move the nodes of periodic edges, as they read them, by 1e-15 m.
using Place = std::pair<std::int64_t, std::int64_t>;
Place place_of(double x, double y) { return {std::llround(x * 1e12), std::llround(y * 1e12)}; }
using Elements = std::multiset<std::vector<Place>>;  ///< corners in the file's order

struct Content {
  Elements quads;
  std::map<std::string, Elements> curves;
};

Content as_gmsh_reads(const std::filesystem::path& file) {
  const meshes::GmshSession session;
  gmsh::open(file.string());
  std::vector<std::size_t> numbers;
  std::vector<double> coordinates, parameters;
  gmsh::model::mesh::getNodes(numbers, coordinates, parameters);
  std::map<std::size_t, Place> places_of;
  for (std::size_t n = 0; n < numbers.size(); ++n) places_of[numbers[n]] = place_of(coordinates[3 * n], coordinates[3 * n + 1]);
  const auto elements = [&places_of](int dimension, int entity, std::size_t corners) {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> tags, nodes;
    gmsh::model::mesh::getElements(types, tags, nodes, dimension, entity);
    Elements result;
    for (std::size_t k = 0; k < types.size(); ++k) {
      const std::size_t count = nodes[k].size() / tags[k].size();
      for (std::size_t e = 0; e < tags[k].size(); ++e) {
        std::vector<Place> places;
        for (std::size_t c = 0; c < corners; ++c) places.push_back(places_of.at(nodes[k][e * count + c]));
        result.insert(places);
      }
    }
    return result;
  };
  Content content{elements(2, -1, 4), {}};
  gmsh::vectorpair groups;
  gmsh::model::getPhysicalGroups(groups, 1);
  for (const auto& [dimension, group] : groups) {
    std::string name;
    std::vector<int> entities;
    gmsh::model::getPhysicalName(dimension, group, name);
    gmsh::model::getEntitiesForPhysicalGroup(dimension, group, entities);
    for (const int entity : entities) content.curves[name].merge(elements(1, entity, 2));
  }
  return content;
}

Content as_we_read(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const meshes::MshFile msh = meshes::parse_msh(std::string(std::istreambuf_iterator<char>(stream), {}));
  const auto places = [&](const auto& tags) {
    std::vector<Place> result;
    for (const auto tag : tags) result.push_back(place_of(msh.nodes.at(tag)[0], msh.nodes.at(tag)[1]));
    return result;
  };
  Content content;
  for (const auto& quad : msh.quads) content.quads.insert(places(quad.corners));
  for (const auto& line : msh.lines) {
    const auto names = msh.curve_names.find(line.curve);
    if (names == msh.curve_names.end()) continue;
    for (const std::string& name : names->second) content.curves[name].insert(places(line.ends));
  }
  return content;
}

TEST(GmshMesh, IsReadAsGmshReadsIt) {
  const Workplace place;
  for (const auto& [name, make] : kinds) {
    for (const Format format : formats) {
      write(make, place / "strip.msh", format);
      const Content gmshs = as_gmsh_reads(place / "strip.msh"), ours = as_we_read(place / "strip.msh");
      EXPECT_EQ(ours.quads, gmshs.quads) << name << ", format " << format.version << (format.bytes ? " in bytes" : "");
      EXPECT_EQ(ours.curves, gmshs.curves) << name << ", format " << format.version << (format.bytes ? " in bytes" : "");
      EXPECT_EQ(ours.curves.size(), 4U);
      for (const bool periodic : {false, true}) {
        EXPECT_NO_THROW(meshes::read_user_mesh(place / "strip.msh", {strip_length, strip_width, periodic})) << name;
      }
    }
  }
}

Json on_mesh(Json base, const std::string& file) {
  base["id"] = base["id"].get<std::string>() + " " + file;
  base.erase("elements");
  base["mesh"] = file + ".msh";
  base["degree"] = 8;
  base["time"] = {{"integrator", "exact"}, {"step_fraction", 1.0}, {"end", 5e-6}};
  base["sample_every"] = 1;
  return base;
}

TEST(GmshMesh, CarriesPlaneWaves) {
  const Workplace place;
  std::vector<Json> cases;
  for (const auto& [name, make] : kinds) {
    write(make, place / (std::string(name) + ".msh"), {4.1, false});
    cases.push_back(on_mesh(shear_case("shear"), name));
    cases.push_back(on_mesh(bar_case("bar"), name));
  }
  place.write("cases.json", case_file(cases));
  const auto outcome = place.run("cases.json -o signals.h5");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  const SignalsReader reader(place / "signals.h5");
  const auto gaussian = [](double x) { return 1e-6 * std::exp(-0.5 * std::pow((x - 3e-3) / 3e-4, 2)); };
  const double bar_speed = std::sqrt(1e10 / 1700.0), shear_speed = std::sqrt(1e10 / 2.6 / 1700.0);
  for (const auto& [name, make] : kinds) {
    const auto shear = compare(reader.signals(std::string("shear ") + name), receiver_places(), 1, ReleasedPulse{gaussian, strip_length, 1}, shear_speed);
    const auto bar = compare(reader.signals(std::string("bar ") + name), receiver_places(), 0, ReleasedPulse{gaussian, strip_length, -1}, bar_speed);
    // Equal rectangles of this size reach 5e-7; elements a quarter longer than those would make it four times as much.
    EXPECT_LT(shear.relative_l2, 2e-6) << name;  // measured 1e-7 to 5e-7
    EXPECT_LT(bar.relative_l2, 2e-6) << name;
    EXPECT_LT(std::abs(shear.speed), 1e-8) << name;  // measured 1e-9
    EXPECT_LT(std::abs(bar.speed), 1e-8) << name;
  }
}

}  // namespace
}  // namespace ddem::fem
