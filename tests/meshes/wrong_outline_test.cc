// Right meshes whose outline or its names are damaged at many places: refused, with the reason.

#include <gtest/gtest.h>

#include "tests/meshes/damage.h"

namespace ddem::meshes {
namespace {

using test::strip_mesh;
using test::TestMesh;

// Of the names: places are the lines of the outline.
const Damage name_damages[] = {
    {"line missing", "is in no physical curve", [](TestMesh& m, int k, int) { m.lines.erase(m.lines.begin() + k); }},
    {"line nameless", "is in no physical curve", [](TestMesh& m, int k, int) { m.lines[k].group = 0; }},
    {"line in the wrong curve", "which lies on the", [](TestMesh& m, int k, int) { m.lines[k].group = m.lines[(k + 2 * ny + nx) % outline].group; }},
    {"line in two curves", "which lies on the",
     [](TestMesh& m, int k, int) {
       m.lines.push_back(m.lines[k]);
       m.lines.back().group = m.lines[(k + 2 * ny + nx) % outline].group;
     }},
    {"line moved inside", "which lies inside the strip", [](TestMesh& m, int k, int) { m.lines.push_back({m.node(2, 1), m.node(2, 2), m.lines[k].group}); }},
    {"line across an element", "which is no edge of an element", [](TestMesh& m, int k, int) { m.lines.push_back({m.node(2, 1), m.node(3, 2), m.lines[k].group}); }},
    {"line over two edges", "which is no edge of an element", [](TestMesh& m, int k, int) { m.lines.push_back({m.node(0, 0), m.node(2, 0), m.lines[k].group}); }},
    {"line to a loose node", "has a node that is no corner",
     [](TestMesh& m, int k, int) {
       m.nodes[800] = {0.001, 0.0, 0.0};
       m.lines[k].b = 800;
     }},
};

TEST(WrongMesh, WrongNamesAreRefusedOnEveryLine) {
  for (const Damage& damage : name_damages) {
    for (int k = 0; k < outline; ++k) {
      TestMesh m = strip_mesh(nx, ny);
      damage.apply(m, k, 0);
      for (const StripSpec& strip : {test::test_strip, test::periodic_test_strip}) {
        const std::string reason = refusal(msh_text(m), strip);
        EXPECT_NE(reason.find(damage.reason), std::string::npos) << damage.name << ", line " << k + 1 << ": " << reason;
        EXPECT_EQ(reason.find('\n'), std::string::npos) << reason;
      }
    }
  }
}

TEST(WrongMesh, EveryExchangeOfNamesIsRefused) {
  std::vector<std::string> names{"bottom", "left", "right", "top"};
  do {
    TestMesh m = strip_mesh(nx, ny);
    m.names = {{7, names[0]}, {9, names[1]}, {3, names[2]}, {4, names[3]}};
    const bool right = names == std::vector<std::string>{"left", "right", "bottom", "top"};
    EXPECT_EQ(refusal(msh_text(m), test::test_strip).empty(), right) << names[0] << names[1] << names[2] << names[3];
  } while (std::next_permutation(names.begin(), names.end()));
  for (const int group : {7, 9, 3, 4}) {
    TestMesh m = strip_mesh(nx, ny);
    const std::string name = m.names[group];
    m.names[group] = "Left\x1b[2J";
    const std::string reason = refusal(msh_text(m), test::test_strip);
    EXPECT_NE(reason.find("has no physical curve \"" + name + "\""), std::string::npos) << reason;
    EXPECT_NE(reason.find("Left?[2J"), std::string::npos) << reason;
    m.names.erase(group);
    EXPECT_NE(refusal(msh_text(m), test::test_strip).find("has no physical curve \"" + name + "\""), std::string::npos);
  }
}

TEST(WrongMesh, PeriodicNodesWithoutPartnersAreRefused) {
  for (int i = 1; i < nx; ++i) {
    for (const int j : {0, ny}) {
      for (const double shift : {-0.3, -2e-4, 2e-4, 1e-3, 0.3}) {
        TestMesh m = strip_mesh(nx, ny);
        m.at(i, j)[0] += shift * 0.01 / nx;
        const std::string reason = refusal(msh_text(m), test::periodic_test_strip);
        EXPECT_NE(reason.find(fmt::format("node {} at ({:.6g}, {:.6g}) has no partner", m.node(i, ny), m.at(i, ny)[0], m.at(i, ny)[1])), std::string::npos)
            << reason;
        EXPECT_EQ(refusal(msh_text(m), test::test_strip), "");
      }
    }
  }
  // Three edges on one side against one on the other.
  for (const bool up : {false, true}) {
    TestMesh m;
    const auto y = [&](double part) { return 0.002 * (up ? 1.0 - part : part); };
    for (int k = 0; k < 4; ++k) m.nodes[1 + k] = {0.01 * k / 3, y(0.0), 0.0};
    m.nodes[5] = {0.01 / 3, y(0.5), 0.0};
    m.nodes[6] = {0.02 / 3, y(0.5), 0.0};
    m.nodes[7] = {0.0, y(1.0), 0.0};
    m.nodes[8] = {0.01, y(1.0), 0.0};
    m.quads = {{{1, 2, 5, 7}}, {{2, 3, 6, 5}}, {{3, 4, 8, 6}}, {{5, 6, 8, 7}}};
    m.lines = {{1, 7, 7}, {4, 8, 9}, {1, 2, up ? 4 : 3}, {2, 3, up ? 4 : 3}, {3, 4, up ? 4 : 3}, {7, 8, up ? 3 : 4}};
    EXPECT_EQ(refusal(msh_text(m), test::test_strip), "");
    EXPECT_NE(refusal(msh_text(m), test::periodic_test_strip).find("node 2 at (0.00333333, "), std::string::npos);
  }
}

TEST(WrongMesh, SizesAreTheStrips) {
  const auto scaled = [](double fx, double fy) {
    TestMesh m = strip_mesh(nx, ny);
    for (auto& [tag, place] : m.nodes) place = {place[0] * fx, place[1] * fy, 0.0};
    return refusal(msh_text(m), test::test_strip);
  };
  EXPECT_NE(scaled(1e3, 1e3).find("1e+03 times as large: coordinates are metres (gmsh: Mesh.ScalingFactor = 0.001)"), std::string::npos) << scaled(1e3, 1e3);
  EXPECT_NE(scaled(1e-3, 1e-3).find("Mesh.ScalingFactor = 1e+03"), std::string::npos);
  EXPECT_NE(scaled(1.0, 2.0).find("is 0.01 m long and 0.004 m wide, the strip 0.01 m and 0.002 m"), std::string::npos);
  EXPECT_EQ(scaled(2.0, 1.0).find("times"), std::string::npos);
  for (const double wrong : {1.0 + 3e-6, 1.0 - 3e-6}) {
    EXPECT_FALSE(scaled(wrong, 1.0).empty());
    EXPECT_FALSE(scaled(1.0, wrong).empty());
  }
  EXPECT_EQ(scaled(1.0 + 3e-7, 1.0 - 3e-7), "");
}

TEST(WrongMesh, OutlinesThatAreNoRectangleAreRefused) {
  for (const double dent : {3e-6, 1e-5, 1e-3, 0.1}) {
    for (int k = 1; k < nx; ++k) {
      TestMesh m = strip_mesh(nx, ny, 0.0);
      m.at(k, ny)[1] -= dent * 0.002;
      EXPECT_NE(refusal(msh_text(m), test::test_strip).find("an outline that is no rectangle"), std::string::npos) << dent;
    }
    for (int k = 1; k < ny; ++k) {
      TestMesh m = strip_mesh(nx, ny, 0.0);
      m.at(0, k)[0] += dent * 0.002;
      EXPECT_NE(refusal(msh_text(m), test::test_strip).find("an outline that is no rectangle"), std::string::npos) << dent;
    }
  }
  TestMesh lean = strip_mesh(nx, ny, 0.0);  // a parallelogram of the right extent
  for (auto& [tag, place] : lean.nodes) place[0] = 0.9 * place[0] + 0.5 * place[1];
  EXPECT_NE(refusal(msh_text(lean), test::test_strip).find("an outline that is no rectangle"), std::string::npos);
}

}  // namespace
}  // namespace ddem::meshes
