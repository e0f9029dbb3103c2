// Right meshes of a strip, however they are written; what is no mesh, and damaged bytes.

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <set>

#include "meshes/msh_file.h"
#include "tests/support/strip_meshes.h"
#include "tests/support/work_folder.h"

namespace ddem::meshes {
namespace {

using test::is_mesh_of;
using test::strip_mesh;
using test::TestMesh;

constexpr int nx = 7, ny = 4;

// Places of the corners of each element, whatever the order of elements, corners and nodes.
std::set<std::set<std::array<double, 2>>> shape_of(const QuadMesh& mesh) {
  std::set<std::set<std::array<double, 2>>> shape;
  for (const auto& quad : mesh.quads) {
    std::set<std::array<double, 2>> places;
    for (const unsigned v : quad) places.insert({std::round(mesh.vertices[v][0] * 1e12), std::round(mesh.vertices[v][1] * 1e12)});
    shape.insert(places);
  }
  return shape;
}

using Change = std::function<void(TestMesh&)>;

void renumber(TestMesh& m, unsigned seed) {
  std::mt19937 random(seed);
  std::map<int, int> fresh;
  std::vector<int> tags;
  for (const auto& [tag, place] : m.nodes) tags.push_back(3 * tag + 11);
  std::shuffle(tags.begin(), tags.end(), random);
  std::map<int, std::array<double, 3>> nodes;
  for (const auto& [tag, place] : m.nodes) {
    fresh[tag] = tags[fresh.size()];
    nodes[fresh.at(tag)] = place;
  }
  m.nodes = nodes;
  for (auto& line : m.lines) line = {fresh.at(line.b), fresh.at(line.a), line.group};
  for (auto& quad : m.quads) {
    for (int& corner : quad.corners) corner = fresh.at(corner);
  }
  std::shuffle(m.lines.begin(), m.lines.end(), random);
  std::shuffle(m.quads.begin(), m.quads.end(), random);
}

void turn(TestMesh& m, int first_column) {
  for (int i = first_column; i < nx; ++i) {
    for (int j = 0; j < ny; ++j) {
      std::swap(m.quad(i, j).corners[1], m.quad(i, j).corners[3]);
      m.quad(i, j).surface = 2;
    }
  }
}

const std::pair<const char*, Change> harmless[] = {
    {"none", [](TestMesh&) {}},
    {"renumbered", [](TestMesh& m) { renumber(m, 1); }},
    {"elements from any corner",
     [](TestMesh& m) {
       for (std::size_t k = 0; k < m.quads.size(); ++k) std::rotate(m.quads[k].corners.begin(), m.quads[k].corners.begin() + k % 4, m.quads[k].corners.end());
     }},
    {"clockwise", [](TestMesh& m) { turn(m, 0); }},
    {"two surfaces, one clockwise", [](TestMesh& m) { turn(m, 3); }},
    {"elsewhere",
     [](TestMesh& m) {
       for (auto& [tag, place] : m.nodes) place = {place[0] - 0.25, place[1] + 0.5, 0.0};
     }},
    {"out of the plane by round-off",
     [](TestMesh& m) {
       for (auto& [tag, place] : m.nodes) place[2] = (tag % 3 - 1) * 1e-10;
     }},
    {"points of construction", [](TestMesh& m) { m.nodes[999] = {3.0, 4.0, 5.0}; }},
    {"other curves",
     [](TestMesh& m) {
       m.names[50] = "receivers";
       m.names[51] = "outline";
       for (int k = 0; k < ny; ++k) m.lines.push_back({m.node(3, k), m.node(3, k + 1), 50});
       for (int k = 0; k < ny; ++k) m.lines.push_back({m.node(0, k), m.node(0, k + 1), 51});
     }},
    {"lines twice", [](TestMesh& m) { m.lines.insert(m.lines.end(), m.lines.begin(), m.lines.begin() + 5); }},
    {"a curve in two groups of one name",
     [](TestMesh& m) {
       m.names[60] = "left";
       m.lines[0].group = 60;
     }},
    {"sides and partners by round-off",
     [](TestMesh& m) {
       for (int i = 1; i < nx; ++i) m.at(i, ny) = {m.at(i, ny)[0] + (i % 2 ? 3e-13 : -3e-13), 0.002 - 1e-13, 0.0};
       for (int j = 1; j < ny; ++j) m.at(nx, j)[0] += j % 2 ? 1e-13 : -1e-13;
     }},
};

TEST(RightMesh, IsTheSameHoweverItIsWritten) {
  for (const StripSpec& strip : {test::test_strip, test::periodic_test_strip}) {
    const QuadMesh wanted = parse_user_mesh(msh_text(strip_mesh(nx, ny)), strip);
    EXPECT_TRUE(is_mesh_of(wanted, strip));
    EXPECT_EQ(wanted.quads.size(), nx * ny);
    EXPECT_EQ(wanted.edges.size(), 2 * (nx + ny));
    for (const auto& [name, change] : harmless) {
      TestMesh m = strip_mesh(nx, ny);
      change(m);
      const QuadMesh mesh = parse_user_mesh(msh_text(m), strip);
      EXPECT_TRUE(is_mesh_of(mesh, strip)) << name;
      EXPECT_EQ(shape_of(mesh), shape_of(wanted)) << name;
      EXPECT_EQ(mesh.vertices.size(), wanted.vertices.size()) << name;
    }
  }
}

TEST(RightMesh, MayHaveAnyNumberOfElements) {
  for (const auto& [columns, rows] : {std::pair(1, 1), std::pair(1, 5), std::pair(5, 1), std::pair(2, 2), std::pair(200, 40)}) {
    for (const StripSpec& strip : {test::test_strip, test::periodic_test_strip}) {
      EXPECT_TRUE(is_mesh_of(parse_user_mesh(msh_text(strip_mesh(columns, rows)), strip), strip)) << columns << " x " << rows;
    }
  }
}

TEST(RightMesh, NodesOfPeriodicEdgesComeToStandOverEachOther) {
  TestMesh m = strip_mesh(nx, ny);
  for (int i = 1; i < nx; ++i) m.at(i, ny)[0] += 5e-5 * 0.01 / nx;
  const QuadMesh free = parse_user_mesh(msh_text(m), test::test_strip), periodic = parse_user_mesh(msh_text(m), test::periodic_test_strip);
  EXPECT_TRUE(is_mesh_of(periodic, test::periodic_test_strip));
  EXPECT_FALSE(is_mesh_of(free, test::periodic_test_strip));
}

std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(MshText, SaysWhatIsWrongAndInWhichLine) {
  const std::string good = msh_text(strip_mesh(2, 1));
  EXPECT_NO_THROW(parse_user_mesh(good, test::test_strip));
  const std::pair<std::string, const char*> wrong[] = {
      {"", "begins with \"\" instead of $MeshFormat"},
      {"SystemCall \"touch EXECUTED\";", "begins with \"SystemCall \" instead of $MeshFormat"},
      {" " + good, "instead of $MeshFormat"},
      {"$NOD\n1\n1 0 0 0\n$ENDNOD\n", "instead of $MeshFormat"},
      {changed(good, "2.2 0 8", "1 0 8"), "line 2: format 1: formats 4.1, 4 and 2.2 are read"},
      {changed(good, "2.2 0 8", "3 0 8"), "line 2: format 3:"},
      {changed(good, "2.2 0 8", "4.2 0 8"), "line 2: format 4.2:"},
      {changed(good, "2.2 0 8", "4 1 8"), "line 2: format 4 in bytes"},
      {changed(good, "2.2 0 8", "2.2 0 4"), "line 2: numbers must be of 8 bytes"},
      {changed(good, "2.2 0 8", "2.2 2 8"), "line 2: the file type is 0 (text) or 1 (bytes)"},
      {changed(good, "$EndMeshFormat", "$PhysicalNames"), "line 3: \"$PhysicalNames\" stands where $EndMeshFormat should"},
      {changed(good, "$Nodes\n6", "$Nodes\n5"), "stands where $EndNodes should"},
      {changed(good, "$Nodes\n6", "$Nodes\n7"), "line 19: \"$EndNodes\" stands where a whole number should"},
      {changed(good, "$Nodes\n6", "$Nodes\n999999999999999999"), "line 19: "},
      {changed(good, "0.01 0 0", "nan 0 0"), "line 17: \"nan\" is no finite number"},
      {changed(good, "0.01 0 0", "1e999 0 0"), "line 17: \"1e999\" is no finite number"},
      {changed(good, "0.01 0 0", "0.0l 0 0"), "line 17: \"0.0l\" stands where a number should"},
      {changed(good, "\n2 0 ", "\n1 0 "), "line 14: a second node 1"},
      {changed(good, " 3 2 20 1 ", " 2 2 20 1 "), "is a triangle: a mesh must consist of quadrilaterals"},
      {changed(good, " 3 2 20 1 ", " 5 2 20 1 "), "is neither a line nor a quadrilateral"},
      {changed(good, " 3 2 20 1 1 3 4 2", " 3 2 20 1 1 3 4 77"), "element 7 has a node 77, which the file does not hold"},
      {changed(good, "$EndElements", ""), "the file ends too early"},
      {changed(good, "$PhysicalNames", "$Names"), "$EndNames is missing"},
      {good + "$Nodes\n0\n$EndNodes\n", "a second $Nodes"},
      {good + "rest", "\"rest\" stands where a section such as $Nodes should"},
      {good.substr(0, good.find("$Elements")), "the file ends without $Elements"},
      {changed(good, "1 7 \"left\"", "1 7 left"), "a name in quotes is missing"},
      {good + "$PartitionedEntities\n$EndPartitionedEntities\n", "the mesh is in partitions"},
  };
  for (const auto& [text, reason] : wrong) {
    try {
      parse_user_mesh(text, test::test_strip);
      ADD_FAILURE() << "accepted, instead of: " << reason;
    } catch (const MeshError& error) {
      EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what() << "\ninstead of: " << reason;
    }
  }
  EXPECT_NO_THROW(parse_user_mesh(good + "$Comments\n$Nodes\n$EndComments\n$Periodic\n1\n$EndPeriodic\n", test::test_strip));
  std::string crlf;
  for (const char c : good) crlf += c == '\n' ? "\r\n" : std::string(1, c);
  EXPECT_NO_THROW(parse_user_mesh(crlf, test::test_strip));
}

TEST(MshText, NothingButAFileIsRead) {
  const test::WorkFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  std::ofstream(folder / "empty");
  std::ofstream(folder / "huge") << "$MeshFormat";
  std::filesystem::resize_file(folder / "huge", (1ULL << 31) + 1);
  std::ofstream(folder / "holes") << "$MeshFormat";
  std::filesystem::resize_file(folder / "holes", 1 << 20);
  std::filesystem::create_symlink("itself", folder / "itself");
  std::ofstream(folder / "good") << msh_text(strip_mesh(2, 1));
  std::filesystem::create_symlink("good", folder / "link");
  const std::pair<std::filesystem::path, const char*> wrong[] = {
      {folder / "pipe", "is no file"},   {folder / "missing", "is no file"},      {folder / "", "is no file"},
      {"/dev/zero", "is no file"},       {folder / "empty", "is empty"},          {folder / "huge", "is larger than 2 GiB"},
      {folder / "holes", "line 1: "},    {folder / "itself", "cannot be read: "}, {"/proc/self/status", "is empty"},
      {"/bin/sh", "instead of $MeshFormat"}};
  for (const auto& [file, reason] : wrong) {
    try {
      read_user_mesh(file, test::test_strip);
      ADD_FAILURE() << file;
    } catch (const MeshError& error) {
      EXPECT_EQ(std::string(error.what()).find(reason) == std::string::npos, false) << file << ": " << error.what();
    }
  }
  EXPECT_EQ(read_user_mesh(folder / "link", test::test_strip).quads.size(), 2U);
}

// Bytes changed, cut off and moved: refused, or still a mesh of the strip.
TEST(MshText, DamageIsRefusedOrHarmless) {
  const std::string good = msh_text(strip_mesh(3, 2));
  std::mt19937 random(7);
  const auto below = [&](std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(random); };
  std::vector<std::size_t> lines{0};
  for (std::size_t k = 0; k + 1 < good.size(); ++k) {
    if (good[k] == '\n') lines.push_back(k + 1);
  }
  lines.push_back(good.size());
  const auto line = [&](std::size_t k) { return good.substr(lines[k], lines[k + 1] - lines[k]); };
  int refused = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    std::string bad = good;
    switch (trial % 5) {
      case 0: bad[below(bad.size())] = static_cast<char>(below(256)); break;
      case 1: bad.resize(below(bad.size())); break;
      case 2: bad[below(bad.size())] = "0123456789.-e $\n"[below(16)]; break;
      case 3: bad.erase(below(bad.size()), 1 + below(20)); break;
      case 4: {
        const std::size_t a = below(lines.size() - 2), b = a + 1 + below(lines.size() - 2 - a);
        bad = good.substr(0, lines[a]) + line(b) + good.substr(lines[a + 1], lines[b] - lines[a + 1]) + line(a) + good.substr(lines[b + 1]);
      }
    }
    for (const StripSpec& strip : {test::test_strip, test::periodic_test_strip}) {
      try {
        EXPECT_TRUE(is_mesh_of(parse_user_mesh(bad, strip), strip)) << bad;
      } catch (const MeshError& error) {
        ++refused;
        EXPECT_STRNE(error.what(), "");
      }
    }
  }
  EXPECT_GT(refused, 2000);
}

}  // namespace
}  // namespace ddem::meshes
