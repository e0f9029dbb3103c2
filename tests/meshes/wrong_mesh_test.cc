// Right meshes whose elements are damaged in one way at many places: refused, with the reason, between free and periodic edges.

#include <gtest/gtest.h>

#include "tests/meshes/damage.h"

namespace ddem::meshes {
namespace {

using test::strip_mesh;
using test::TestMesh;

int copy_of(TestMesh& m, int tag) {
  m.nodes[1000 + tag] = m.nodes.at(tag);
  return 1000 + tag;
}

// Of element (i, j).
int inner_node(const TestMesh& m, int i, int j) {
  return m.node(std::max(i, 1), std::max(j, 1));
}

void replace(TestMesh::Quad& quad, int from, int to) {
  std::replace(quad.corners.begin(), quad.corners.end(), from, to);
}

// Of element (i, j) into two, by nodes in the middle of two opposite edges.
void halve(TestMesh& m, int i, int j, bool across) {
  const auto c = m.quad(i, j).corners;
  const auto middle = [&](int a, int b, int tag) {
    for (int k = 0; k < 3; ++k) m.nodes[tag][k] = 0.5 * (m.nodes.at(a)[k] + m.nodes.at(b)[k]);
    return tag;
  };
  const int p = across ? middle(c[0], c[1], 900) : middle(c[1], c[2], 900), q = across ? middle(c[3], c[2], 901) : middle(c[0], c[3], 901);
  m.quad(i, j).corners = across ? std::array{c[0], p, q, c[3]} : std::array{c[0], c[1], p, q};
  m.quads.push_back({across ? std::array{p, c[1], c[2], q} : std::array{q, p, c[2], c[3]}});
}

// Of the elements; places (i, j) are all of them.
const Damage element_damages[] = {
    {"doubled", "are one", [](TestMesh& m, int i, int j) { m.quads.push_back(m.quad(i, j)); }},
    {"doubled, from another corner and turned", "are one",
     [](TestMesh& m, int i, int j) {
       auto c = m.quad(i, j).corners;
       std::rotate(c.begin(), c.begin() + 1, c.end());
       m.quads.push_back({{c[3], c[2], c[1], c[0]}});
     }},
    {"missing", "a hole, a slit", [](TestMesh& m, int i, int j) { m.quads.erase(m.quads.begin() + i * ny + j); }},
    {"column missing", "a hole, a slit", 
     [](TestMesh& m, int i, int) {
       const int column = std::clamp(i, 1, nx - 2);
       m.quads.erase(m.quads.begin() + column * ny, m.quads.begin() + (column + 1) * ny);
     }},
    {"crossed", "is crossed (a bow-tie)", [](TestMesh& m, int i, int j) { std::swap(m.quad(i, j).corners[1], m.quad(i, j).corners[2]); }},
    {"crossed the other way", "is crossed (a bow-tie)", [](TestMesh& m, int i, int j) { std::swap(m.quad(i, j).corners[0], m.quad(i, j).corners[1]); }},
    {"turned", "is turned", [](TestMesh& m, int i, int j) { std::swap(m.quad(i, j).corners[1], m.quad(i, j).corners[3]); }},
    {"a node twice", "has a node twice", [](TestMesh& m, int i, int j) { m.quad(i, j).corners[3] = m.quad(i, j).corners[0]; }},
    {"flat", "has two sides in one line",
     [](TestMesh& m, int i, int j) {
       const auto& c = m.quad(i, j).corners;
       for (int k = 0; k < 2; ++k) m.nodes[900][k] = 0.5 * (m.nodes.at(c[0])[k] + m.nodes.at(c[2])[k]);
       replace(m.quad(i, j), c[1], 900);
     }},
    {"flat to a ten thousandth", "has two sides in one line",
     [](TestMesh& m, int i, int j) {
       const auto& c = m.quad(i, j).corners;
       for (int k = 0; k < 2; ++k) m.nodes[900][k] = 0.4999 * (m.nodes.at(c[0])[k] + m.nodes.at(c[2])[k]) + 0.0002 * m.nodes.at(c[1])[k];
       replace(m.quad(i, j), c[1], 900);
     }},
    {"bent inwards", "has a corner that turns inwards",
     [](TestMesh& m, int i, int j) {
       const auto& c = m.quad(i, j).corners;
       for (int k = 0; k < 2; ++k) m.nodes[900][k] = 0.3 * m.nodes.at(c[0])[k] + 0.3 * m.nodes.at(c[2])[k] + 0.4 * m.nodes.at(c[3])[k];
       replace(m.quad(i, j), c[1], 900);
     }},
    {"a corner of its own", "lie at one place", [](TestMesh& m, int i, int j) { replace(m.quad(i, j), inner_node(m, i, j), copy_of(m, inner_node(m, i, j))); }},
    {"a corner of its own, moved by 1e-8", "lie at one place",
     [](TestMesh& m, int i, int j) {
       const int copy = copy_of(m, inner_node(m, i, j));
       m.nodes[copy][0] -= 1e-8 * 0.002;
       replace(m.quad(i, j), inner_node(m, i, j), copy);
     }},
    {"halved across", "hangs on", [](TestMesh& m, int i, int j) { halve(m, i, j, true); }},
    {"halved along", "hangs on", [](TestMesh& m, int i, int j) { halve(m, i, j, false); }},
    {"an element more, outside of all others", "is 0.02",
     [](TestMesh& m, int i, int j) {
       std::array<int, 4> c{};
       for (int k = 0; k < 4; ++k) {
         c[k] = copy_of(m, m.quad(i, j).corners[k]);
         m.nodes[c[k]][0] += 0.02 - m.nodes.at(m.node(i, j))[0];
       }
       m.quads.push_back({c});
     }},
    {"a node that is not there", "which the file does not hold", [](TestMesh& m, int i, int j) { m.quad(i, j).corners[2] = 5000; }},
    {"out of the plane", "has z =", [](TestMesh& m, int i, int j) { m.at(i, j)[2] = 1e-5; }},
};

TEST(WrongMesh, DamagedElementsAreRefusedWherever) {
  for (const Damage& damage : element_damages) {
    for (int i = 0; i < nx; ++i) {
      for (int j = 0; j < ny; ++j) {
        TestMesh m = strip_mesh(nx, ny);
        damage.apply(m, i, j);
        for (const StripSpec& strip : {test::test_strip, test::periodic_test_strip}) {
          const std::string reason = refusal(msh_text(m), strip);
          EXPECT_NE(reason.find(damage.reason), std::string::npos) << damage.name << " at " << i << ", " << j << ": " << reason;
          EXPECT_EQ(reason.find('\n'), std::string::npos) << damage.name << ": " << reason;
        }
      }
    }
  }
}

// Copies of the nodes of a line of nodes for the elements beyond it.
TestMesh slit(bool upright, int at, int from, int to) {
  TestMesh m = strip_mesh(nx, ny);
  for (int k = from; k <= to; ++k) {
    const int node = upright ? m.node(at, k) : m.node(k, at), copy = copy_of(m, node);
    for (int i = 0; i < nx; ++i) {
      for (int j = 0; j < ny; ++j) {
        if (upright ? i >= at : j >= at) replace(m.quad(i, j), node, copy);
      }
    }
    for (auto& line : m.lines) {
      const bool beyond = upright ? std::min(line.a, line.b) >= m.node(at, 0) && line.a != line.b - 1 : line.group != 3 && std::max(line.a, line.b) % (ny + 1) != 1;
      if (!beyond) continue;
      if (upright && line.a == node) line.a = copy;
    }
  }
  return m;
}

TEST(WrongMesh, SlitsAreRefusedHoweverLongAndWide) {
  for (const double width : {0.0, 1e-12, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4}) {
    for (const bool upright : {true, false}) {
      for (int at = 1; at < (upright ? nx : ny); ++at) {
        const int end = upright ? ny : nx;
        for (const auto& [from, to] : {std::pair(0, end), std::pair(1, end - 1), std::pair(1, 1), std::pair(0, 1)}) {
          TestMesh m = slit(upright, at, from, to);
          for (auto& [tag, place] : m.nodes) {
            if (tag > 1000) place[upright ? 0 : 1] += width;
          }
          for (const StripSpec& strip : {test::test_strip, test::periodic_test_strip}) {
            const std::string reason = refusal(msh_text(m), strip);
            EXPECT_FALSE(reason.empty()) << width << " wide, " << upright << ", " << at << ", " << from << " to " << to;
          }
        }
      }
    }
  }
}

TEST(WrongMesh, SheetsOnSheetsAreRefused) {
  TestMesh twice = strip_mesh(nx, ny), other = strip_mesh(nx + 2, ny + 1);
  for (const auto& [tag, place] : other.nodes) twice.nodes[tag + 2000] = place;
  for (auto quad : other.quads) {
    for (int& corner : quad.corners) corner += 2000;
    twice.quads.push_back(quad);
  }
  EXPECT_NE(refusal(msh_text(twice), test::test_strip).find("lie at one place"), std::string::npos);
  // Two sheets that share their four corners alone: each by itself is right.
  TestMesh corners = strip_mesh(nx, ny), over = strip_mesh(nx + 1, ny + 1);
  for (const auto& [tag, place] : over.nodes) corners.nodes[tag + 2000] = place;
  for (auto quad : over.quads) {
    for (int& corner : quad.corners) corner += 2000;
    for (const int i : {0, 1}) {
      for (const int j : {0, 1}) replace(quad, over.node(i * over.nx, j * over.ny) + 2000, corners.node(i * nx, j * ny));
    }
    corners.quads.push_back(quad);
  }
  EXPECT_NE(refusal(msh_text(corners), test::test_strip).find("cover 2 times the area"), std::string::npos) << refusal(msh_text(corners), test::test_strip);
  // Two sheets that share their outline alone: each edge there belongs to two elements, and the rest to none.
  TestMesh bag = strip_mesh(2, 2), sheet = strip_mesh(2, 2, -0.2);
  bag.nodes[77] = sheet.at(1, 1);
  for (auto quad : sheet.quads) {
    replace(quad, sheet.node(1, 1), 77);
    bag.quads.push_back(quad);
  }
  EXPECT_NE(refusal(msh_text(bag), test::test_strip).find("overlaps others"), std::string::npos);
}

}  // namespace
}  // namespace ddem::meshes
