// Held means held, from the first instant: what a start moves on a held edge is refused by name, or at rest.

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "tests/harness/cli/program.h"

namespace ddem::harness::test {
namespace {

using testing::HasSubstr;

constexpr std::size_t kDiscs = 240;

class HeldStart : public Cli {
 protected:
  /// A comment, the header, and a row a disc: that of `disc` is `row`, the others `others`.
  void write_state(const std::string& name, std::size_t disc, const std::string& row, const std::string& others = "0,0,0") const {
    std::string text = "# a state\nux,uy,theta\n";
    for (std::size_t d = 0; d < kDiscs; ++d) text += (d == disc ? row : others) + "\n";
    write(name, text);
  }
  static std::string state_scene(const std::string& initial, const std::string& edges) {
    std::string scene = small_scene();
    scene.erase(scene.find("[boundary]"));
    return scene + "[boundary]\ntop_bottom = \"periodic\"\n" + edges + "\n[initial]\n" + initial +
           "\n[time]\nsteps = 20\n[probes]\ndiscs = [29, 28, 0, 14]\n";
  }
  static std::string pulse_scene(const std::string& initial, const std::string& edges) {
    return replaced(replaced(small_scene(), "amplitude = \"1 um\"", "amplitude = \"1 um\"\n" + initial), "top_bottom = \"periodic\"",
                    "top_bottom = \"periodic\"\n" + edges);
  }
  /// Of the last row: disc29_ux, disc29_uy, disc29_theta.
  std::vector<double> held_disc() const {
    const auto run = ddem({"run", path("scene.toml"), "--signals", path("s.csv")});
    EXPECT_EQ(run.exit_code, 0) << run.standard_error;
    const std::string text = read("s.csv");
    std::istringstream last(text.substr(text.rfind('\n', text.size() - 2) + 1));
    std::vector<double> values;
    for (std::string field; std::getline(last, field, ',');) values.push_back(std::stod(field));
    return {values.at(1), values.at(2), values.at(3)};
  }
};

/// Every component, edge and kind of state; disc 29 is the last of the first row, disc 0 the first. The third line of the file
/// is that of disc 0.
TEST_F(HeldStart, OfAFileIsRefusedByLineDiscAndEdge) {
  struct Case {
    const char *edge, *row;
    std::size_t disc;
    bool refused;
  };
  for (const char* key : {"displacement", "velocity"}) {
    for (const Case& c : {Case{"right = \"fixed\"", "1e-9,0,0", 29, true}, Case{"right = \"fixed\"", "0,-1e-9,0", 29, true},
                          Case{"right = \"fixed\"", "0,0,1e-9", 29, true}, Case{"right = \"fixed\"", "1e-9,1e-9,1e-9", 14, false},
                          Case{"right = \"fixed_x\"", "1e-9,0,0", 29, true}, Case{"right = \"fixed_x\"", "0,1e-9,1e-9", 29, false}, Case{"", "1e-9,0,0", 29, true},
                          Case{"right = \"free\"", "1e-9,1e-9,1e-9", 29, false}, Case{"right = \"free\"\nleft = \"fixed\"", "0,0,1e-9", 0, true},
                          Case{"right = \"free\"\nleft = \"fixed_x\"", "1e-9,0,0", 0, true}, Case{"right = \"free\"\nleft = \"fixed_x\"", "0,1e-9,0", 0, false}}) {
      write_state("state.csv", c.disc, c.row);
      write("scene.toml", state_scene(fmt::format("{} = \"state.csv\"", key), c.edge));
      const auto run = ddem({"run", path("scene.toml")});
      EXPECT_EQ(run.exit_code, c.refused ? 2 : 0) << key << c.edge << c.row << run.standard_error;
      if (!c.refused) continue;
      EXPECT_THAT(run.standard_error, HasSubstr(fmt::format("state.csv:{}: ", c.disc + 3)));
      EXPECT_THAT(run.standard_error, HasSubstr(fmt::format("initial.{} moves disc {}, which boundary.", key, c.disc)));
      EXPECT_THAT(run.standard_error, HasSubstr("write 0, or "));
      EXPECT_EQ(run.standard_output, "");
    }
  }
}

TEST_F(HeldStart, OfAWholeStripThrownAtAWallIsRefusedInAFewLines) {
  write_state("v.csv", 0, "1,0,0", "1,0,0");
  write("scene.toml", state_scene("velocity = \"v.csv\"", "right = \"fixed\""));
  const auto run = ddem({"run", path("scene.toml")});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_LE(std::count(run.standard_error.begin(), run.standard_error.end(), '\n'), 22);
}

/// Beside 1 m/s, 1e-13 m/s is round-off of whoever wrote the file: at rest it is.
TEST_F(HeldStart, RoundOffIsRest) {
  write_state("v.csv", 29, "1e-13,0,0", "0,0,0");
  std::string rows = read("v.csv");
  write("v.csv", rows.replace(rows.find("0,0,0"), 5, "1,0,0"));
  write("scene.toml", state_scene("velocity = \"v.csv\"", "right = \"fixed\""));
  EXPECT_EQ(held_disc(), (std::vector<double>{0.0, 0.0, 0.0}));
}

/// The strip is 5.9 mm between its outermost centres; the edge's discs lie within 0.1 mm of it.
TEST_F(HeldStart, OfAPulseThatReachesAHeldEdge) {
  struct Case {
    const char *initial, *edge;
    bool refused;
  };
  for (const char* wave : {"longitudinal", "shear"}) {
    const bool shear = wave == std::string("shear");
    for (const Case& c : {Case{"shape = \"gaussian\"\nwidth = \"3 mm\"", "right = \"fixed\"", true}, Case{"shape = \"gaussian\"\nwidth = \"1 mm\"", "right = \"fixed\"", false},
                          Case{"shape = \"gaussian\"\nwidth = \"0.2 mm\"\ncenter = \"5.8 mm\"", "right = \"fixed\"", true},
                          Case{"shape = \"gaussian\"\nwidth = \"3 mm\"", "right = \"free\"", false}, Case{"shape = \"gaussian\"\nwidth = \"3 mm\"", "right = \"fixed_x\"", !shear},
                          Case{"shape = \"cosine\"\nwidth = \"7 mm\"", "right = \"fixed\"", true}, Case{"shape = \"cosine\"\nwidth = \"5 mm\"", "right = \"fixed\"", false},
                          Case{"shape = \"cosine\"\nwidth = \"2 mm\"", "left = \"fixed\"", true}, Case{"shape = \"cosine\"\nwidth = \"2 mm\"", "left = \"fixed_x\"", !shear},
                          Case{"shape = \"column\"", "right = \"fixed\"", false}}) {
      const std::string scene = replaced(pulse_scene(c.initial, c.edge), "\"longitudinal\"", fmt::format("\"{}\"", wave));
      write("scene.toml", replaced(scene, "[probes]\npairs = 3", "[time]\nend = \"1e-7 s\"\n[probes]\ndiscs = [29]"));
      const auto run = ddem({"run", path("scene.toml")});
      EXPECT_EQ(run.exit_code, c.refused ? 2 : 0) << wave << c.initial << c.edge << run.standard_error;
      if (!c.refused) {
        if (c.edge != std::string("right = \"free\"") && !shear) {
          EXPECT_EQ(held_disc()[0], 0.0) << c.initial;
        }
        continue;
      }
      EXPECT_THAT(run.standard_error, HasSubstr("initial.width"));
      EXPECT_THAT(run.standard_error, HasSubstr("the pulse displaces disc "));
      EXPECT_THAT(run.standard_error, HasSubstr("use a narrower pulse"));
    }
  }
}

/// A strip so short that its discs belong to both edges.
TEST_F(HeldStart, OfDiscsThatAreMovedAndHeld) {
  const std::string short_strip = replaced(replaced(small_scene(), "columns = 30", "columns = 1"), "pairs = 3", "discs = [0]") + "[time]\nsteps = 3\n";
  const std::string drive = replaced(short_strip, "[initial]\nwave = \"longitudinal\"\n", "[drive]\nwave = \"longitudinal\"\nduration = \"1 us\"\n");
  for (const std::string& scene : {short_strip, drive}) {
    write("scene.toml", scene);
    const auto run = ddem({"run", path("scene.toml")});
    EXPECT_EQ(run.exit_code, 2) << run.standard_error;
    EXPECT_THAT(run.standard_error, HasSubstr("boundary.right = \"fixed_x\" (the default) holds"));
    EXPECT_THAT(run.standard_error, HasSubstr("edge_band"));
    write("scene.toml", replaced(scene, "top_bottom = \"periodic\"", "top_bottom = \"periodic\"\nright = \"free\""));
    EXPECT_EQ(ddem({"run", path("scene.toml")}).exit_code, 0);
  }
}

#ifdef DDEM_HAS_FEM
TEST_F(HeldStart, OfTheContinuumIsRefusedAlike) {
  const std::string continuum = "[continuum]\nyoung_modulus = 1e10\npoisson_ratio = 0.2\ndensity = 1800\n";
  for (const auto& [initial, refused] : {std::pair("shape = \"gaussian\"\nwidth = \"3 mm\"", true), std::pair("shape = \"cosine\"\nwidth = \"7 mm\"", true),
                                         std::pair("shape = \"cosine\"\nwidth = \"2 mm\"", false)}) {
    write("scene.toml", pulse_scene(initial, "right = \"fixed\"") + continuum);
    const auto run = ddem({"fem", path("scene.toml")});
    EXPECT_EQ(run.exit_code, refused ? 2 : 0) << initial << run.standard_error;
    if (refused) {
      EXPECT_THAT(run.standard_error, HasSubstr("the pulse displaces the right edge"));
    }
  }
}
#endif

}  // namespace
}  // namespace ddem::harness::test
