#include "harness/scene/csv.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>

#include "tests/harness/scene/scene_text.h"

namespace ddem::harness::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

std::string disc_messages(std::string_view text) {
  return to_string(parse_disc_table(text, "discs.csv").violations);
}

TEST(Csv, ReadsDiscs) {
  const auto table =
      parse_disc_table("# a comment\nx,y,radius\n0.1,-2e-3,1\n# another\n 3 ,\t4,5e-1", "discs.csv");
  ASSERT_TRUE(table) << to_string(table.violations);
  EXPECT_THAT(table->x, ElementsAre(0.1, 3.0));
  EXPECT_THAT(table->y, ElementsAre(-2e-3, 4.0));
  EXPECT_THAT(table->radius, ElementsAre(1.0, 0.5));
}

TEST(Csv, ReadsBondsAndStates) {
  const auto bonds = parse_bond_table("i,j\n0,1\n12,3\n", "bonds.csv");
  ASSERT_TRUE(bonds) << to_string(bonds.violations);
  EXPECT_THAT(*bonds, ElementsAre(std::pair(0, 1), std::pair(12, 3)));
  const auto state = parse_state_table("ux,uy,theta\n1,2,3\n", "u0.csv");
  ASSERT_TRUE(state) << to_string(state.violations);
  EXPECT_THAT(state->ux, ElementsAre(1.0));
  EXPECT_THAT(state->uy, ElementsAre(2.0));
  EXPECT_THAT(state->theta, ElementsAre(3.0));
}

TEST(Csv, TakesCarriageReturnsByteOrderMarksAndEmptyLinesAtTheEnd) {
  const auto table = parse_disc_table("\xEF\xBB\xBFx,y,radius\r\n1,2,3\r\n4,5,6\r\n\r\n \n", "discs.csv");
  ASSERT_TRUE(table) << to_string(table.violations);
  EXPECT_THAT(table->radius, ElementsAre(3.0, 6.0));
}

// Numbers as other programs write them: taken, or refused with the line, the column and what to write. Never read otherwise.
TEST(Csv, NumbersOfOtherPrograms) {
  for (const char* number : {"1", "+1", "+1.0", "1.", "1e0", "1E+0", "+1e+00", " 1 ", "\t1\t", "0.1e1", "001"}) {
    const auto table = parse_disc_table(fmt::format("x,y,radius\n+0.0,-0.0,{}\n", number), "discs.csv");
    ASSERT_TRUE(table) << number << ": " << to_string(table.violations);
    EXPECT_EQ(table->radius[0], 1.0) << number;
    EXPECT_EQ(table->x[0], 0.0);
  }
  for (const char* number : {"0x1p0", "0x1", "1d0", "1,0", "1;0", "1'000", "1 000", "1_000", "++1", "+-1", "-+1", "+", "-", ".", "e1", "1e", "\"1\"", "one", "NaN",
                             "-nan", "Infinity", "1e13", "-1e13", "1e400", "1e-19", "1m", "1f", "\xC2\xA0" "1"}) {
    EXPECT_THAT(disc_messages(fmt::format("x,y,radius\n0,0,1\n0,0,{}\n", number)), StartsWith("discs.csv:3: r")) << number;
  }
  EXPECT_TRUE(parse_bond_table("i,j\n+0,+1\n", "b"));
  EXPECT_FALSE(parse_bond_table("i,j\n+0,+-1\n", "b"));
}

TEST(Csv, SeparatorsOfOtherPrograms) {
  const auto commas = HasSubstr("write x,y,radius, separated by commas and with points in the numbers");
  EXPECT_THAT(disc_messages("x;y;radius\n0,5;0,5;0,1\n"), commas);
  EXPECT_THAT(disc_messages("x\ty\tradius\n0\t0\t1\n"), commas);
  EXPECT_THAT(disc_messages("x,y,radius\n0,5;0,5;0,1\n"), commas);
  EXPECT_THAT(disc_messages("x,y,radius\n0,0,1,\n"), HasSubstr("discs.csv:2: row = 0,0,1,: 4 fields instead of 3; write x,y,radius, without a comma"));
  EXPECT_THAT(disc_messages("x,y,radius\r0,0,1\r"), HasSubstr("end lines with a line feed"));
  EXPECT_THAT(disc_messages("x y radius\n0 0 1\n"), HasSubstr("not the header"));
}

TEST(Csv, SaysWhatIsWrongWhere) {
  EXPECT_EQ(disc_messages("x,y,radius\n0,nan,1\n"),
            "discs.csv:2: y = nan: not a finite number; write a finite number in SI units\n");
  EXPECT_THAT(disc_messages("x,y,radius\n0,inf,1\n"), HasSubstr("not a finite number"));
  EXPECT_THAT(disc_messages("x,y,radius\n0,1e999,1\n"), HasSubstr("too large or too small"));
  EXPECT_THAT(disc_messages("x,y,radius\n0,1 mm,1\n"), HasSubstr("y = 1 mm: not a number"));
  EXPECT_THAT(disc_messages("x,y,radius\n0,,1\n"), HasSubstr("not a number"));
  EXPECT_THAT(disc_messages("x,y,radius\n0,0,-1\n"), HasSubstr("radius = -1: must be greater than 0"));
  EXPECT_THAT(disc_messages("x,y,radius\n0,0,0\n"), HasSubstr("must be greater than 0"));
  EXPECT_THAT(disc_messages("x,y,radius\n0,0\n"), HasSubstr("discs.csv:2: row = 0,0: 2 fields instead of 3"));
  EXPECT_THAT(disc_messages("x,y,radius\n0,0,1,\n"), HasSubstr("4 fields instead of 3"));
  EXPECT_THAT(disc_messages("x,y,radius\n0,0,1\n\n0,0,1\n"),
              HasSubstr("discs.csv:3: row: 0 fields instead of 3"));
  EXPECT_THAT(disc_messages("x,radius,y\n0,0,1\n"),
              StartsWith("discs.csv:1: header = x,radius,y: not the header"));
  EXPECT_THAT(disc_messages("0,0,1\n"), HasSubstr("write x,y,radius"));
  EXPECT_THAT(disc_messages("# x,y,radius\n"), HasSubstr("an empty file"));
  EXPECT_THAT(disc_messages(""), HasSubstr("an empty file"));
  EXPECT_THAT(disc_messages("x,y,radius\n"), HasSubstr("no rows"));
  EXPECT_THAT(disc_messages(std::string("x,y,radius\n\x01\xff\0,0,1\n", 19)),
              HasSubstr("x = \\x01\\xff\\x00: not a number"));
  const auto bond_messages = [](std::string_view text) {
    return to_string(parse_bond_table(text, "b").violations);
  };
  EXPECT_THAT(bond_messages("i,j\n0,0\n"), HasSubstr("a disc bonded to itself"));
  EXPECT_THAT(bond_messages("i,j\n0,-1\n"), HasSubstr("negative"));
  EXPECT_THAT(bond_messages("i,j\n0,1.5\n"), HasSubstr("not a whole number"));
  EXPECT_THAT(bond_messages("i,j\n0,99999999999\n"), HasSubstr("too large"));
}

TEST(Csv, ListsTwentyProblemsAndCountsTheRest) {
  std::string text = "x,y,radius\n";
  for (int k = 0; k < 50; ++k) text += "0,0,-1\n";
  const auto table = parse_disc_table(text, "discs.csv");
  ASSERT_EQ(table.violations.size(), 21u);
  EXPECT_EQ(table.violations[19].line, 21);
  EXPECT_EQ(to_string(table.violations[20]), "discs.csv: and 30 more");
}

TEST(Csv, FilesThatCannotBeRead) {
  EXPECT_THAT(to_string(read_disc_table(temporary_folder() / "no.csv").violations),
              HasSubstr("No such file"));
  EXPECT_THAT(to_string(read_bond_table(temporary_folder()).violations), HasSubstr("this is a folder"));
  EXPECT_TRUE(read_state_table(write_file("state.csv", "ux,uy,theta\n0,0,0\n")));
}

TEST(Csv, NumbersSurviveTheRoundTrip) {
  std::mt19937_64 random(1);
  std::vector<double> x{0.0, -0.0, 5e-324, 1e12, -1e12, 0.1, 16.5e-3}, ones;
  while (x.size() < 2000) {
    const double value = std::bit_cast<double>(random());
    if (std::abs(value) <= 1e12) x.push_back(value);
  }
  ones.assign(x.size(), 1.0);
  const std::vector<std::span<const double>> columns{x, x, ones};
  const std::string text = csv_text("x,y,radius", columns);
  EXPECT_THAT(text, HasSubstr("\n0.1,0.1,1\n0.0165,0.0165,1\n"));
  const auto table = parse_disc_table(text, "discs.csv");
  ASSERT_TRUE(table) << to_string(table.violations);
  ASSERT_EQ(table->x.size(), x.size());
  for (std::size_t k = 0; k < x.size(); ++k) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(table->x[k]), std::bit_cast<std::uint64_t>(x[k]));
  }
}

TEST(Csv, NeverWritesWhatIsNotFinite) {
  std::string text;
  EXPECT_THROW(append_number(text, std::nan("")), std::invalid_argument);
  EXPECT_THROW(append_number(text, HUGE_VAL), std::invalid_argument);
  EXPECT_EQ(text, "");
}

}  // namespace
}  // namespace ddem::harness::test
