// Discs and states that a scene names: wrong ones are refused, those just within the limits are not.

#include "tests/harness/cli/program.h"

namespace ddem::harness::test {
namespace {

class BadFiles : public Cli {
 protected:
  /// discs.csv from lines of text.
  void expect_discs_refused(const std::string& table, const std::vector<std::string>& parts) const {
    write("scene.toml", file_scene());
    write("discs.csv", table);
    expect_refused(parts);
  }
};

constexpr double kRadius = 1e-4;
const char* const kFirstRow = "1e-04,1e-04,1e-04\n";  // of disc_table(small_lattice()), its second line

std::string good_table() {
  std::string table = disc_table(small_lattice());
  table.replace(table.find('\n') + 1, table.find('\n', table.find('\n') + 1) - table.find('\n'), kFirstRow);
  return table;
}

TEST_F(BadFiles, AGoodOneRuns) {
  write("scene.toml", file_scene());
  write("discs.csv", good_table());
  EXPECT_EQ(ddem({"run", path("scene.toml")}).exit_code, 0);
}

TEST_F(BadFiles, NaN) {
  expect_discs_refused(replaced(good_table(), kFirstRow, "nan,1e-04,1e-04\n"),
                       {"discs.csv:2: x = nan: not a finite number", "write a finite number"});
}

TEST_F(BadFiles, Infinity) {
  expect_discs_refused(replaced(good_table(), kFirstRow, "1e-04,-inf,1e-04\n"),
                       {"discs.csv:2: y = -inf: not a finite number"});
}

TEST_F(BadFiles, NegativeRadius) {
  expect_discs_refused(replaced(good_table(), kFirstRow, "1e-04,1e-04,-1e-04\n"),
                       {"discs.csv:2: radius = -0.0001: must be greater than 0"});
}

TEST_F(BadFiles, MissingColumn) {
  expect_discs_refused(replaced(good_table(), kFirstRow, "1e-04,1e-04\n"), {"discs.csv:2"});
}

TEST_F(BadFiles, OtherHeader) {
  expect_discs_refused(replaced(good_table(), "x,y,radius", "x,y,diameter"),
                       {"discs.csv:1: header", "write x,y,radius"});
}

TEST_F(BadFiles, Rubbish) {
  expect_discs_refused(rubbish(5000), {"discs.csv"});
}

TEST_F(BadFiles, Brackets) {
  expect_discs_refused(std::string(100000, '['), {"discs.csv:1"});
}

TEST_F(BadFiles, Empty) {
  expect_discs_refused("", {"discs.csv: an empty file"});
}

// Disc 0, in the corner, moves along its row: it overlaps disc 1 by just the way that it moves.
TEST_F(BadFiles, SixPerCentOfOverlap) {
  std::vector<Disc> discs = small_lattice();
  discs[0].x += 0.06 * kRadius;
  expect_discs_refused(disc_table(discs), {"discs.csv: discs 0 and 1 overlap",
                                           "6 % of the smaller radius: at most 5 % is allowed"});
}

TEST_F(BadFiles, FourPerCentOfOverlapRuns) {
  std::vector<Disc> discs = small_lattice();
  discs[0].x += 0.04 * kRadius;
  write("scene.toml", file_scene());
  write("discs.csv", disc_table(discs));
  EXPECT_EQ(ddem({"run", path("scene.toml")}).exit_code, 0);
}

// The right half moves away by a radius: more than the gap that is bonded.
TEST_F(BadFiles, TwoHalves) {
  std::vector<Disc> discs = small_lattice();
  for (std::size_t d = 0; d < discs.size(); ++d) {
    if (d % 30 >= 15) discs[d].x += kRadius;
  }
  expect_discs_refused(disc_table(discs), {"assembly.packing = \"file\": the assembly falls apart into 2 networks",
                                           "raise bond_gap"});
}

TEST_F(BadFiles, BondOfADiscThatIsNotThere) {
  write("bonds.csv", "i,j\n0,1\n1,240\n");
  write("discs.csv", good_table());
  write("scene.toml",
        replaced(file_scene(), "file = \"discs.csv\"", "file = \"discs.csv\"\nbonds = \"bonds.csv\""));
  expect_refused({"240"});
}

TEST_F(BadFiles, StateWithNaN) {
  std::string state = "ux,uy,theta\n";
  for (int d = 0; d < 240; ++d) state += d == 7 ? "0,nan,0\n" : "1e-7,0,0\n";
  write("u0.csv", state);
  write("scene.toml", replaced(small_scene(), "wave = \"longitudinal\"\namplitude = \"1 um\"",
                               "displacement = \"u0.csv\""));
  expect_refused({"u0.csv:9: uy = nan: not a finite number"});
}

TEST_F(BadFiles, StateOfAnotherNumberOfDiscs) {
  write("u0.csv", "ux,uy,theta\n1e-7,0,0\n");
  write("scene.toml", with_table(replaced(small_scene(), "wave = \"longitudinal\"\namplitude = \"1 um\"",
                                          "displacement = \"u0.csv\""),
                                 "[time]\nsteps = 10"));
  expect_refused({"u0.csv", "240"});
}

}  // namespace
}  // namespace ddem::harness::test
