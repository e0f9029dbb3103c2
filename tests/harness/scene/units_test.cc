#include "harness/scene/units.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ddem::harness {
namespace {

using testing::HasSubstr;

struct Case {
  const char* text;
  Dimension dimension;
  double si;
};

class UnitsTest : public testing::TestWithParam<Case> {};

// Equality, not nearness: the literal on the right is rounded once, and so must be the text on the left.
TEST_P(UnitsTest, GivesTheCorrectlyRoundedSiValue) {
  const Quantity quantity = parse_quantity(GetParam().text, GetParam().dimension);
  ASSERT_TRUE(quantity.si) << GetParam().text << ": " << quantity.problem;
  EXPECT_EQ(*quantity.si, GetParam().si) << GetParam().text;
}

using enum Dimension;
INSTANTIATE_TEST_SUITE_P(
    All, UnitsTest,
    testing::Values(Case{"16.5 mm", length, 16.5e-3}, Case{"2 mm", length, 2e-3}, Case{"1 um", length, 1e-6},
                    Case{"1 \u00B5m", length, 1e-6}, Case{"1 \u03BCm", length, 1e-6},
                    Case{"0.113mm", length, 0.113e-3}, Case{"3.3 nm", length, 3.3e-9},
                    Case{"7 pm", length, 7e-12}, Case{"1.7 cm", length, 1.7e-2}, Case{"0.3 m", length, 0.3},
                    Case{"-2 km", length, -2e3}, Case{"  +4.1e+2\tmm ", length, 0.41},
                    Case{"2e-5 s", time, 2e-5}, Case{"3 us", time, 3e-6}, Case{"1.1 ns", time, 1.1e-9},
                    Case{"20 ms", time, 20e-3}, Case{"10 GPa", stress, 10e9}, Case{"200 MPa", stress, 200e6},
                    Case{"1 TPa", stress, 1e12}, Case{"5 kPa", stress, 5e3}, Case{"4e10 Pa", stress, 4e10},
                    Case{"3 N/mm2", stress, 3e6}, Case{"3 N/m^2", stress, 3.0},
                    Case{"30 kN/mm²", stress, 30e9}, Case{"2000 kg/m3", density, 2000.0},
                    Case{"2.6 g/cm3", density, 2600.0}, Case{"2 kg/m^3", density, 2.0},
                    Case{"1.9 t/m³", density, 1900.0}, Case{"2.1 kg/dm3", density, 2100.0},
                    Case{"1e10 N/m", stiffness, 1e10}, Case{"3 MN/m", stiffness, 3e6},
                    Case{"10 GN/m", stiffness, 1e10}, Case{"7 kN/m", stiffness, 7e3},
                    Case{"5 N/mm", stiffness, 5e3}, Case{".5 mm", length, 0.5e-3},
                    Case{"5. mm", length, 5e-3}, Case{"0e99999999999 m", length, 0.0},
                    Case{"50 kHz", frequency, 50e3}, Case{"2.5 MHz", frequency, 2.5e6}, Case{"1 GHz", frequency, 1e9},
                    Case{"7 Hz", frequency, 7.0}));

struct Wrong {
  const char* text;
  Dimension dimension;
  const char* problem;
};

TEST(Units, SayWhatIsWrong) {
  const Wrong wrongs[] = {{"16.5 kg", length, "\"kg\" is not a known unit of length"},
                          {"16.5 GPa", length, "\"GPa\" is a unit of stress, but a length is expected"},
                          {"16.5 mm", time, "is a unit of length, but a time is expected"},
                          {"5 mPa", stress, "not a known unit"},
                          {"5 MM", length, "not a known unit"},
                          {"5 m m", length, "not a known unit"},
                          {"5", length, "needs a unit"},
                          {"", length, "beginning with a number"},
                          {"mm", length, "beginning with a number"},
                          {"nan m", length, "beginning with a number"},
                          {"inf m", length, "beginning with a number"},
                          {". m", length, "beginning with a number"},
                          {"--1 m", length, "beginning with a number"},
                          {"0x10 m", length, "not a known unit"},
                          {"1e m", length, "not a known unit"},
                          {"1e308 GPa", stress, "too large or too small"},
                          {"1e-320 pm", length, "too large or too small"},
                          {"1e99999999999 m", length, "too large or too small"},
                          {"1e-99999999999 m", length, "too large or too small"}};
  for (const Wrong& wrong : wrongs) {
    const Quantity quantity = parse_quantity(wrong.text, wrong.dimension);
    EXPECT_FALSE(quantity.si) << wrong.text;
    EXPECT_THAT(quantity.problem, HasSubstr(wrong.problem)) << wrong.text;
  }
}

// The examples that error messages give are themselves right.
TEST(Units, ExamplesCanBeRead) {
  for (const Dimension dimension : {length, time, stress, density, stiffness}) {
    const std::string_view examples = quantity_examples(dimension);
    const std::size_t quote = examples.find('"');
    ASSERT_NE(quote, std::string_view::npos);
    const std::string_view first = examples.substr(quote + 1, examples.find('"', quote + 1) - quote - 1);
    EXPECT_TRUE(parse_quantity(first, dimension).si) << first;
    const std::string one = "1 " + std::string(si_unit(dimension));
    EXPECT_EQ(parse_quantity(one, dimension).si, 1.0) << one;
  }
}

TEST(FormatQuantity, IsBetweenOneAndAThousandWhereItsUnitAllows) {
  EXPECT_EQ(format_quantity(0.000112733, "m"), "112.733 um");
  EXPECT_EQ(format_quantity(12.0, "m"), "12 m");
  EXPECT_EQ(format_quantity(0.5, "m"), "500 mm");
  EXPECT_EQ(format_quantity(999.9999999e-6, "m"), "1 mm");
  EXPECT_EQ(format_quantity(59.099e-9, "s", 5), "59.099 ns");
  EXPECT_EQ(format_quantity(1.33e10, "Pa"), "13.3 GPa");
  EXPECT_EQ(format_quantity(-2.7209598, "Pa"), "-2.72096 Pa");
  EXPECT_EQ(format_quantity(-2.7e9, "N/m"), "-2.7 GN/m");
  EXPECT_EQ(format_quantity(0.02, "Pa"), "0.02 Pa");
  EXPECT_EQ(format_quantity(2728.25, "m/s"), "2728.25 m/s");
  EXPECT_EQ(format_quantity(0.0, "m"), "0 m");
}

}  // namespace
}  // namespace ddem::harness
