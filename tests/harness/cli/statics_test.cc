// ddem moduli and its siblings on packings of users: narrow strips, packings from files without a size or with a wrong one,
// listed bonds.
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "harness/io/json.h"
#include "tests/harness/cli/program.h"

namespace ddem::harness::test {
namespace {

using testing::HasSubstr;

constexpr double kRadius = 1e-4;

struct Strip {
  std::string along = "x";
  int columns = 40, rows = 9;
  double stiffness_ratio = 0.25;
  std::string more = "";  ///< lines of other tables

  std::string lattice() const {
    return fmt::format("[assembly]\npacking = \"hexagonal\"\nclose_packed_along = \"{}\"\ncolumns = {}\nrows = {}\nradius = {}\n", along, columns, rows, kRadius);
  }
  std::string matter() const {
    return fmt::format("[material]\ndensity = 2000\n[contact]\nnormal_stiffness = 1e10\nstiffness_ratio = {}\n{}", stiffness_ratio, more);
  }
  std::string name() const { return fmt::format("{} x {} along {}, k_t/k_n = {}, {}", columns, rows, along, stiffness_ratio, more); }
};

std::string deformable() {
  return "[deformation]\nscheme = \"implicit\"\ncorrection = \"full\"\nyoung_modulus = 4e10\npoisson_ratio = 0.3\n";
}

class Statics : public Cli {
 protected:
  Json moduli(const std::string& scene) {
    write("scene.toml", scene);
    const SubprocessResult r = ddem({"moduli", path("scene.toml"), "--json"});
    EXPECT_EQ(r.exit_code, 0) << scene << r.standard_error;
    return r.exit_code == 0 ? Json::parse(r.standard_output) : Json();
  }
  /// The very discs of a scene, as a file.
  void pack(const std::string& scene) {
    write("packed.toml", scene);
    const SubprocessResult r = ddem({"pack", path("packed.toml"), "-o", path("discs.csv")});
    EXPECT_EQ(r.exit_code, 0) << r.standard_error;
  }
  static std::string from_file(const Strip& s, const std::string& lines = "") {
    return "[assembly]\npacking = \"file\"\nfile = \"discs.csv\"\n" + lines + s.matter();
  }
  void expect_refusal(const std::string& scene, const std::vector<std::string>& parts) {
    write("scene.toml", scene);
    for (const std::vector<std::string>& command : {std::vector<std::string>{"moduli", path("scene.toml")}, {"pack", path("scene.toml"), "-o", path("p.csv")}}) {
      const SubprocessResult r = ddem(command);
      EXPECT_EQ(r.exit_code, 2) << scene << r.standard_output;
      for (const std::string& part : parts) EXPECT_THAT(r.standard_error, HasSubstr(part));
    }
  }
};

double number(const Json& j, const char* key) { return j.contains(key) && j[key].is_number() ? j[key].get<double>() : std::nan(""); }

/// One row is a chain, k_n/(1 + 4 k_n/(pi E_p)) with deformable discs; what holds it sideways does not matter.
TEST_F(Statics, OfASingleRowAreTheChains) {
  const double mass = 2000 * std::numbers::pi * kRadius * kRadius;
  for (const double ratio : {0.0, 0.3, 1.0}) {
    for (const std::string& more : {std::string(), deformable()}) {
      const Strip s{.columns = 60, .rows = 1, .stiffness_ratio = ratio, .more = more};
      const double softening = more.empty() ? 1.0 : 1.0 + 4.0 * 1e10 / (std::numbers::pi * 4e10);
      // With F the slip of a chain's bonds is none, and its discs contract freely.
      const double speed = 2.0 * kRadius * std::sqrt(1e10 / softening / mass);
      const Json lattice = moduli(s.lattice() + s.matter());
      EXPECT_NEAR(number(lattice, "bar_velocity") / speed, 1.0, 1e-9) << s.name();
      EXPECT_TRUE(lattice["strip"]["lateral_contraction"].is_null());
      EXPECT_TRUE(lattice["strip"]["lateral_contraction_status"].is_string());
      pack(s.lattice());
      const Json file = moduli(from_file(s));
      EXPECT_NEAR(number(file, "bar_velocity") / speed, 1.0, 1e-9) << s.name();
      EXPECT_TRUE(file["young_modulus"].is_null());
      EXPECT_THAT(file["young_modulus_status"].get<std::string>(), HasSubstr("give assembly.width"));
    }
  }
}

/// The number is of an independent dense solution of the infinite strip's cell.
TEST_F(Statics, OfTwoRowsAreTheStrips) {
  const Strip s{.rows = 2, .stiffness_ratio = 0.4};
  EXPECT_NEAR(number(moduli(s.lattice() + s.matter()), "bar_velocity"), 2667.43, 0.005);
}

/// Discs are discs, from a file or a lattice: without a size the file's is the lattice's. exp(-pi n/2) of outline.h is 1e-9 at
/// 30 columns along x, whose ramps are 14 diameters. What is the lattice closed in y does not know how many rows it has.
TEST_F(Statics, OfAFileWithoutSizeAreTheLattices) {
  for (const std::string along : {"x", "y"}) {
    for (const auto& [columns, rows] : {std::pair{40, 9}, {60, 2}, {34, 3}, {121, 4}}) {
      const Strip s{.along = along, .columns = columns, .rows = rows, .more = rows == 9 ? deformable() : ""};
      const Json lattice = moduli(s.lattice() + s.matter());
      pack(s.lattice());
      const Json file = moduli(from_file(s, "bond_gap = 0.1\n"));
      EXPECT_NEAR(number(file, "bar_velocity") / number(lattice, "bar_velocity"), 1.0, 1e-8) << s.name();
      for (const char* key : {"bulk_density", "moving_density", "solid_fraction"}) {
        EXPECT_NEAR(number(file, key) / number(lattice, key), 1.0, 1e-8) << s.name() << key;
      }
      const Strip wide{.along = along, .columns = columns, .rows = 12, .more = s.more};
      EXPECT_NEAR(number(lattice, "shear_velocity") / number(moduli(wide.lattice() + wide.matter()), "shear_velocity"), 1.0, 1e-5) << s.name();
    }
  }
}

TEST_F(Statics, OfAFileWithAPeriodButNoLengthAreTheLattices) {
  const Strip s{.columns = 60, .rows = 8, .more = "[boundary]\ntop_bottom = \"periodic\"\n"};
  const Json lattice = moduli(s.lattice() + s.matter());
  pack(s.lattice());
  const Json file = moduli(from_file(s, fmt::format("width = {:.17g}\n", 8 * std::sqrt(3.0) * kRadius)));
  for (const char* key : {"bulk_density", "shear_velocity", "p_velocity"}) EXPECT_NEAR(number(file, key) / number(lattice, key), 1.0, 1e-9) << key;
}

/// Of random strips read back: 0.3 % of the density (outline_test.cc), half of it in speeds.
TEST_F(Statics, OfARandomStripReadBack) {
  const std::string random = "[assembly]\npacking = \"random\"\nlength = \"8 mm\"\nwidth = \"1.6 mm\"\ndiscs = 300\nbond_gap = 0.9\n";
  const Strip s;
  const Json made = moduli(random + s.matter());
  ASSERT_EQ(made["rattlers"], 0);
  pack(random);
  const Json file = moduli(from_file(s, "bond_gap = 0.9\n"));
  EXPECT_NEAR(number(file, "bulk_density") / number(made, "bulk_density"), 1.0, 0.006);
  EXPECT_NEAR(number(file, "bar_velocity") / number(made, "bar_velocity"), 1.0, 0.003);
}

/// With a continuum of its own nothing is asked of the discs.
TEST_F(Statics, AreNotNeededToRunAStripTheyDoNotHave) {
  for (const auto& [columns, rows] : {std::pair{60, 1}, {60, 2}, {14, 6}}) {
    const Strip s{.columns = columns, .rows = rows, .stiffness_ratio = 0.3,
                  .more = "[initial]\nwave = \"longitudinal\"\nshape = \"cosine\"\nwidth = \"0.5 mm\"\namplitude = \"1 um\"\n[probes]\npairs = 1\n[time]\nend = \"1 us\"\n"};
    write("scene.toml", s.lattice() + s.matter() + "[continuum]\nyoung_modulus = 1e10\npoisson_ratio = 0.2\ndensity = 2000\nelements = [8, 2]\n");
    const SubprocessResult run = ddem({"run", path("scene.toml")});
    EXPECT_EQ(run.exit_code, 0) << s.name() << run.standard_error;
#ifdef DDEM_HAS_FEM
    const SubprocessResult fem = ddem({"fem", path("scene.toml")});
    EXPECT_EQ(fem.exit_code, 0) << s.name() << fem.standard_error;
#endif
  }
}

TEST_F(Statics, OfAStripTooShortAreRefused) {
  const Strip s{.columns = 1, .rows = 60};
  write("scene.toml", s.lattice() + s.matter());
  const SubprocessResult r = ddem({"moduli", path("scene.toml")});
  EXPECT_EQ(r.exit_code, 2);
  EXPECT_THAT(r.standard_error, HasSubstr("use at least 30 discs along x"));
}

/// Right is what holds the discs: 121 by 14.12 radii.
TEST_F(Statics, TakeTheSizeThatIsGiven) {
  pack(Strip{.columns = 60, .rows = 8}.lattice());
  const Strip s{.stiffness_ratio = 0.3};
  const Json j = moduli(from_file(s, "length = \"12.1 mm\"\nwidth = \"1.412 mm\"\n"));
  EXPECT_NEAR(number(j, "solid_fraction"), 480 * std::numbers::pi * 1e-8 / (12.1e-3 * 1.412e-3), 1e-12);
  EXPECT_NEAR(number(j, "bulk_density"), 1765, 0.5);
  EXPECT_NEAR(number(j, "bar_velocity"), 2728, 0.5);
}

TEST_F(Statics, RefuseASizeThatContradictsTheDiscs) {
  pack(Strip{.columns = 60, .rows = 8}.lattice());
  const Strip free{.stiffness_ratio = 0.3}, closed{.more = "[boundary]\ntop_bottom = \"periodic\"\n"};
  const std::string right = "length = \"12.1 mm\"\n", width = fmt::format("width = {:.17g}\n", 8 * std::sqrt(3.0) * kRadius);
  expect_refusal(from_file(free, right + "width = \"0.5 mm\"\n"), {"scene.toml:5: assembly.width = \"0.5 mm\"", "discs.csv lie outside of it: their centres span 1.21244 mm"});
  expect_refusal(from_file(free, "width = \"0.5 mm\"\n"), {"assembly.width = \"0.5 mm\""});
  expect_refusal(from_file(closed, "length = \"3 mm\"\n" + width), {"assembly.length = \"3 mm\"", "span 11.9 mm"});
  expect_refusal(from_file(free, "length = \"12 m\"\nwidth = \"1.4 m\"\n"), {"assembly.length = \"12 m\"", "fill only 12.1 mm of it; did you mean millimetres?", "assembly.width = \"1.4 m\""});
  expect_refusal(from_file(free, "length = \"14 mm\"\n"), {"assembly.length = \"14 mm\"", "fill only 12.1 mm of it"});
  expect_refusal(from_file(closed, right + "width = \"2 mm\"\n"), {"assembly.width = \"2 mm\"", "fill only"});
  expect_refusal(from_file(closed, right + "width = \"1.3 mm\"\n"), {"overlap", "correct the periods"});
  pack(Strip{.columns = 60, .rows = 2}.lattice());
  expect_refusal(from_file(free, "length = \"12 mm\"\nwidth = \"0.18 mm\"\n"), {"assembly.width = \"0.18 mm\"", "would fill 1.75 times the 12 mm x 180 um"});
  // Millimetres read as metres.
  std::string table = "x,y,radius\n";
  for (const Disc& d : small_lattice()) table += fmt::format("{},{},{}\n", 1e3 * d.x, 1e3 * d.y, 1e3 * d.radius);
  write("discs.csv", table);
  expect_refusal(from_file(free, "length = \"6.1 mm\"\n"), {"assembly.length = \"6.1 mm\"", "their centres span 5.9 m; x, y and radius of the file are metres: these look like millimetres"});
}

/// Discs that lie on each other are told as such, whatever size that would make.
TEST_F(Statics, RefuseDiscsInOnePlace) {
  std::vector<Disc> discs = small_lattice();
  discs.push_back(discs[7]);
  write("discs.csv", disc_table(discs));
  expect_refusal(from_file(Strip{}), {"discs.csv: discs 7 and 240 overlap", "200 % of the smaller radius"});
  expect_refusal(from_file(Strip{}, "length = \"6.1 mm\"\n"), {"discs 7 and 240 overlap"});
}

/// Hinges in a zigzag: tension straightens them.
TEST_F(Statics, OfAMechanismAreRefused) {
  for (const double ratio : {0.0, 0.3}) {
    const Strip s{.along = "y", .columns = 40, .rows = 1, .stiffness_ratio = ratio};
    write("scene.toml", s.lattice() + s.matter());
    const SubprocessResult r = ddem({"moduli", path("scene.toml"), "--json"});
    EXPECT_EQ(r.exit_code, 3) << r.standard_output;
    EXPECT_THAT(r.standard_error, HasSubstr("mechanism; take more rows or bonds"));
  }
}

/// As wide as its centres reach, or a little wider than its discs: as random packings and lattices are.
TEST_F(Statics, TakeSizesThatMayBe) {
  pack(Strip{.columns = 40, .rows = 4}.lattice());
  for (const std::string size : {"length = 7.9e-3\n", "length = 8.4e-3\n", "width = 6.4e-4\n", "width = 1.1e-3\n"}) {
    EXPECT_GT(number(moduli(from_file(Strip{}, size)), "bar_velocity"), 0.0) << size;
  }
}

TEST_F(Statics, RefuseListedBondsThatAreNone) {
  std::string table = "x,y,radius\n";
  for (int d = 0; d < 12; ++d) table += fmt::format("{},{},{}\n", kRadius * (2 * d + 1), kRadius, kRadius);
  write("discs.csv", table);
  const std::string good = "i,j\n# a chain\n0,1\n1,2\n2,3\n3,4\n4,5\n5,6\n6,7\n7,8\n8,9\n9,10\n10,11\n";
  const Strip s{.stiffness_ratio = 0.3};
  const auto with = [&](const std::string& row) {
    write("bonds.csv", good + row);
    return from_file(s, "bonds = \"bonds.csv\"\n");
  };
  expect_refusal(with("0,4\n"), {"bonds.csv:14: bond 0,4: the discs are 6 mean radii apart; bonds reach over gaps up to 2"});
  expect_refusal(with("0,5\n"), {"bonds.csv:14: bond 0,5: the discs are 8 mean radii apart"});
  expect_refusal(with("2,1\n"), {"bonds.csv:14: bond 2,1: is given twice, first on line 4"});
  expect_refusal(with("1,2\n"), {"bonds.csv:14: bond 1,2: is given twice, first on line 4"});
  expect_refusal(with("3,3\n"), {"bonds.csv:14", "a disc bonded to itself"});
  expect_refusal(with("12,0\n"), {"bonds.csv:14: bond 12,0: disc 12 does not exist; discs are numbered from 0 to 11"});
  expect_refusal(with("0,3\n0,4\n1,2\n"), {"bonds.csv:14: bond 0,3", "bonds.csv:15: bond 0,4", "bonds.csv:16: bond 1,2"});
  // Over a gap of two mean radii a bond may reach.
  write("scene.toml", with("0,2\n"));
  EXPECT_EQ(ddem({"pack", path("scene.toml"), "-o", path("p.csv")}).exit_code, 0);
}

}  // namespace
}  // namespace ddem::harness::test
