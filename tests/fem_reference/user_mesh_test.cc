// A user's mesh: general quadrilaterals from a .msh file, edges by the names of physical groups.

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "tests/fem_reference/case_builder.h"
#include "tests/fem_reference/dalembert.h"
#include "tests/fem_reference/program.h"

namespace ddem::fem {
namespace {

using std::numbers::pi;
using test::bar_case;
using test::case_file;
using test::compare;
using test::Json;
using test::receiver_places;
using test::ReleasedPulse;
using test::shear_case;
using test::Signals;
using test::SignalsReader;
using test::strip_length;
using test::strip_width;
using test::Workplace;

// The strip as nx * ny quadrilaterals with bent inner lines, the lower left corner at (1, 2) m; format 2.2, as other
// programs write it. `last` names the physical curve at the right end.
std::string msh(int nx, int ny, const std::string& last = "right") {
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n5\n1 7 \"left\"\n1 9 \"" + last +
                     "\"\n1 3 \"bottom\"\n1 4 \"top\"\n2 8 \"strip\"\n$EndPhysicalNames\n$Nodes\n";
  text += fmt::format("{}\n", (nx + 1) * (ny + 1));
  const auto node = [&](int i, int j) { return 1 + i * (ny + 1) + j; };
  for (int i = 0; i <= nx; ++i) {
    for (int j = 0; j <= ny; ++j) {
      const double bend = 0.3 * std::sin(pi * j / ny) * (i % nx == 0 ? 0.0 : std::sin(1.9 * i));
      text += fmt::format("{} {:.17g} {:.17g} 0\n", node(i, j), 1.0 + strip_length * (i + bend) / nx,
                          2.0 + strip_width * (j + (j % ny == 0 ? 0.0 : bend)) / ny);
    }
  }
  text += fmt::format("$EndNodes\n$Elements\n{}\n", nx * ny + 2 * (nx + ny));
  int number = 0;
  const auto line = [&](int group, int a, int b) { text += fmt::format("{} 1 2 {} {} {} {}\n", ++number, group, group, a, b); };
  for (int j = 0; j < ny; ++j) line(7, node(0, j), node(0, j + 1));
  for (int j = 0; j < ny; ++j) line(9, node(nx, j), node(nx, j + 1));
  for (int i = 0; i < nx; ++i) line(3, node(i, 0), node(i + 1, 0));
  for (int i = 0; i < nx; ++i) line(4, node(i, ny), node(i + 1, ny));
  for (int i = 0; i < nx; ++i) {
    for (int j = 0; j < ny; ++j) {
      text += fmt::format("{} 3 2 8 8 {} {} {} {}\n", ++number, node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1));
    }
  }
  return text + "$EndElements\n";
}

Json on_mesh(Json base, const std::string& file) {
  base.erase("elements");
  base["mesh"] = file;
  base["degree"] = 8;
  base["time"]["integrator"] = "exact";
  base["time"]["step_fraction"] = 1.0;
  base["sample_every"] = 1;
  return base;
}

TEST(UserMesh, CarriesPlaneWaves) {
  const Workplace place;
  place.write("bent.msh", msh(33, 4));
  place.write("cases.json", case_file({on_mesh(shear_case("shear"), "bent.msh"), on_mesh(bar_case("bar"), "bent.msh")}));
  const auto outcome = place.run("cases.json -o signals.h5");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  const SignalsReader reader(place / "signals.h5");
  const auto gaussian = [](double x) { return 1e-6 * std::exp(-0.5 * std::pow((x - 3e-3) / 3e-4, 2)); };
  const double bar_speed = std::sqrt(1e10 / 1700.0), shear_speed = std::sqrt(1e10 / 2.6 / 1700.0);
  const auto shear = compare(reader.signals("shear"), receiver_places(), 1, ReleasedPulse{gaussian, strip_length, 1}, shear_speed);
  const auto bar = compare(reader.signals("bar"), receiver_places(), 0, ReleasedPulse{gaussian, strip_length, -1}, bar_speed);
  // Equal rectangles of this size reach 5e-7 with the receivers of their own elements; bent ones are up to 1.6 times as
  // long, which the ninth power of the interpolation makes at most 70 times.
  EXPECT_LT(shear.relative_l2, 5e-6);  // measured 1.7e-6
  EXPECT_LT(bar.relative_l2, 5e-6);    // measured 2.3e-6
  for (const char* id : {"shear", "bar"}) {
    const Signals s = reader.signals(id);
    double worst = 0.0;
    for (std::size_t k = 0; k < s.points.size(); ++k) worst = std::max(worst, std::abs(s.points[k] - s.sections[k]));
    EXPECT_LT(worst, 1e-4 * 1e-6) << id;  // both interpolations
    EXPECT_LT(reader.number(id, "energy_drift"), 1e-12);
  }
  EXPECT_EQ(reader.number("shear", "dofs"), 2 * (33 * 8 + 1) * (4 * 8));
}

TEST(UserMesh, IsRefusedWithItsReason) {
  const Workplace place;
  place.write("nameless.msh", msh(4, 2, "end"));
  place.write("rubbish.msh", "not a mesh");
  place.write("good.msh", msh(4, 2));
  Json longer = on_mesh(shear_case("a"), "good.msh");
  longer["length"] = 0.02;
  const std::pair<Json, const char*> wrong[] = {
      {on_mesh(shear_case("a"), "nameless.msh"), "nameless.msh: has no physical curve \"right\""},
      {on_mesh(shear_case("a"), "missing.msh"), "missing.msh: is no file"},
      {on_mesh(shear_case("a"), "rubbish.msh"), "rubbish.msh: "},
      {longer, "good.msh: is 0.0165 m long and 0.002 m wide, the strip 0.02 m and 0.002 m"}};
  for (const auto& [strip, reason] : wrong) {
    place.write("cases.json", case_file({strip}));
    const auto outcome = place.run("cases.json -o signals.h5");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.errors.find(reason), std::string::npos) << outcome.errors;
  }
  EXPECT_EQ(place.file_count(), 4u);
}

}  // namespace
}  // namespace ddem::fem
