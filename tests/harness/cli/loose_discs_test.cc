// A strip from a file has the ends of its network: a disc without bonds beside it is no part of it.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/io/json.h"
#include "tests/harness/cli/program.h"

namespace ddem::harness::test {
namespace {

using testing::HasSubstr;

constexpr double kRadius = 1e-4;

/// The lattice of small_lattice(), twice as long and free above and below, with all its bonds listed.
class LooseDiscs : public Cli {
 protected:
  void SetUp() override {
    for (int row = 0; row < 8; ++row) {
      for (int column = 0; column < 60; ++column) lattice_.push_back({kRadius * (2 * column + 1 + row % 2), kRadius * (1 + row * std::sqrt(3.0)), kRadius});
    }
    std::string bonds = "i,j\n";
    for (std::size_t i = 0; i < lattice_.size(); ++i) {
      for (std::size_t j = i + 1; j < lattice_.size(); ++j) {
        if (std::hypot(lattice_[i].x - lattice_[j].x, lattice_[i].y - lattice_[j].y) < 2.1 * kRadius) bonds += fmt::format("{},{}\n", i, j);
      }
    }
    write("bonds.csv", bonds);
  }

  static std::string scene(const std::string& load, const std::string& bonding = "bonds = \"bonds.csv\"") {
    return fmt::format("[assembly]\npacking = \"file\"\nfile = \"discs.csv\"\n{}\n[material]\ndensity = 2000\n[contact]\nnormal_stiffness = 1e10\nstiffness_ratio = 0.25\n{}\n"
                       "[probes]\npairs = 3\nsection = true\n",
                       bonding, load);
  }

  /// Sums over all discs have another order.
  static void expect_near(double a, double b) { EXPECT_NEAR(a / b, 1.0, 1e-12); }

  Json json_of(const std::vector<std::string>& arguments) const {
    const auto run = ddem(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.standard_error;
    return Json::parse(run.standard_output, nullptr, false);
  }

  std::vector<Disc> lattice_;
};

/// Left, right, above and below, far away and so near that it nearly touches.
TEST_F(LooseDiscs, MoveNoEndOfTheStrip) {
  const std::string loads[] = {"[drive]\nwave = \"shear\"\nduration = 2e-6\namplitude = 1e-8",
                               "[boundary]\nright = \"free\"\n[initial]\nwave = \"longitudinal\"\nshape = \"gaussian\"\nwidth = 6e-4\namplitude = 1e-8"};
  const double length = 121 * kRadius, width = kRadius * (2.0 + 7.0 * std::sqrt(3.0));
  for (const std::string& load : loads) {
    write("scene.toml", scene(load));
    write("discs.csv", disc_table(lattice_));
    const Json alone = json_of({"run", path("scene.toml"), "--json"}), moduli = json_of({"moduli", path("scene.toml"), "--json"}),
               packing = json_of({"pack", path("scene.toml"), "-o", path("out.csv"), "--json"});
    ASSERT_EQ(alone["wave_speed_status"], "ok") << load;
    for (const auto& [x, y] : {std::pair(-1.2 * kRadius, 0.5 * width), std::pair(-20.0 * kRadius, 0.5 * width), std::pair(length + 1.5 * kRadius, 0.5 * width),
                               std::pair(length + 30.0 * kRadius, 0.0), std::pair(0.5 * length, -1.5 * kRadius), std::pair(0.5 * length, width + 10.0 * kRadius)}) {
      SCOPED_TRACE(fmt::format("{}: {:.3g} {:.3g}", load, x, y));
      std::vector<Disc> discs = lattice_;
      discs.push_back({x, y, kRadius});
      write("discs.csv", disc_table(discs));
      const Json run = json_of({"run", path("scene.toml"), "--json"});
      EXPECT_EQ(run["rattlers"], 1);
      for (const char* key : {"wave_speed", "wave_speed_by_correlation", "pairs", "steps", "bonds"}) EXPECT_EQ(run[key], alone[key]) << key;
      expect_near(run["moving_density"], alone["moving_density"]);
      const Json now = json_of({"moduli", path("scene.toml"), "--json"});
      for (const char* key : {"axial_stiffness", "mass_per_length", "bar_velocity", "lateral_contraction"}) expect_near(now["strip"][key], moduli["strip"][key]);
      const Json packed = json_of({"pack", path("scene.toml"), "-o", path("out.csv"), "--json"});
      EXPECT_EQ(packed["length"], packing["length"]);
      EXPECT_EQ(packed["width"], packing["width"]);
      EXPECT_EQ(packed["discs"], 481);
    }
  }
}

/// Where a gap makes the bonds, one that has none is a mistake of the file: it is named.
TEST_F(LooseDiscs, AreRefusedWhereAGapMakesTheBonds) {
  write("scene.toml", scene("[drive]\nwave = \"shear\"\nduration = 2e-6\namplitude = 1e-8", "bond_gap = 0.1"));
  std::vector<Disc> discs = lattice_;
  discs.push_back({-20.0 * kRadius, 5.0 * kRadius, kRadius});
  write("discs.csv", disc_table(discs));
  const auto run = ddem({"run", path("scene.toml")});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.standard_error, HasSubstr("scene.toml:4: assembly.bond_gap = 0.1: the assembly falls apart"));
  EXPECT_THAT(run.standard_error, HasSubstr("disc 480"));
}

/// A pulse and its echo from an end are one, or two; in between they are neither, and no speed is made of them.
class PulseNearAnEnd : public Cli {
 protected:
  Json run_of(const std::string& initial, const std::string& boundary = "right = \"free\"") const {
    const std::string scene = replaced(small_scene(), "columns = 30", "columns = 60");
    write("scene.toml", scene.substr(0, scene.find("[boundary]")) + "[boundary]\ntop_bottom = \"periodic\"\n" + boundary + "\n[initial]\nwave = \"longitudinal\"\namplitude = 1e-8\n" +
                            initial + "\n[probes]\npairs = 3\n");
    const auto run = ddem({"run", path("scene.toml"), "--json"});
    if (run.exit_code != 0) return Json{{"exit_code", run.exit_code}, {"said", run.standard_error}};
    return Json::parse(run.standard_output, nullptr, false);
  }
};

TEST_F(PulseNearAnEnd, IsMeasuredAtItOrFarFromItAndElseRefused) {
  // 12 mm; a gaussian of 0.4 mm reaches 1.2 mm. At the end its two halves are one pulse, beyond 0.8 mm they are two.
  for (const double center : {0.0, 0.3e-3, 0.95e-3}) EXPECT_EQ(run_of(fmt::format("shape = \"gaussian\"\nwidth = 4e-4\ncenter = {}", center))["wave_speed_status"], "ok") << center;
  for (const double center : {0.45e-3, 0.6e-3, 0.75e-3, 11.3e-3, 11.8e-3, 12.1e-3}) {
    const Json j = run_of(fmt::format("shape = \"gaussian\"\nwidth = 4e-4\ncenter = {}", center));
    ASSERT_TRUE(j.contains("wave_speed")) << j;
    EXPECT_TRUE(j["wave_speed"].is_null()) << center;
    EXPECT_THAT(j["wave_speed_status"].get<std::string>(), HasSubstr("so near to an end of the strip that it meets its own echo")) << center;
  }
  for (const double center : {-3e-3, 15e-3}) {
    const Json j = run_of(fmt::format("shape = \"gaussian\"\nwidth = 4e-4\ncenter = {}", center));
    EXPECT_EQ(j["exit_code"], 2);
    EXPECT_THAT(j["said"].get<std::string>(), HasSubstr("initial.center = ")) << j;
    EXPECT_THAT(j["said"].get<std::string>(), HasSubstr("beside the strip")) << j;
  }
}

/// Whose support reaches the other end, which is held, or beyond; or just so far that its probes see its start.
TEST_F(PulseNearAnEnd, OfACosineThatFillsTheStripIsRefused) {
  for (const double width : {12.2e-3, 15e-3, 1.0}) {
    const Json held = run_of(fmt::format("shape = \"cosine\"\nwidth = {}", width), "right = \"fixed_x\"");
    EXPECT_EQ(held["exit_code"], 2);
    EXPECT_THAT(held["said"].get<std::string>(), HasSubstr("initial.width = ")) << held;
  }
  for (const double width : {2.8e-3, 5e-3, 11e-3, 12.2e-3, 1.0}) {
    const Json j = run_of(fmt::format("shape = \"cosine\"\nwidth = {}", width));
    ASSERT_TRUE(j.contains("wave_speed")) << j;
    EXPECT_EQ(j["wave_speed"].is_null(), width > 2.9e-3) << width << j["wave_speed_status"];
    if (j["wave_speed"].is_null()) {
      // Of a width that no strip holds there is no other to recommend.
      EXPECT_THAT(j["wave_speed_status"].get<std::string>(), HasSubstr(width < 0.1 ? "initial.width at most" : "put the probes further away")) << width;
    }
  }
}

}  // namespace
}  // namespace ddem::harness::test
