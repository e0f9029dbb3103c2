// The file that says where sensors stand: what it holds, and what is wrong with it.

#include "harness/run/laboratory_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ddem::harness {
namespace {

using testing::HasSubstr;

constexpr const char* kSensors = "[[sensor]]\ncolumn = \"a\"\nposition = \"12 mm\"\n[[sensor]]\ncolumn = \"b\"\nposition = 0.022\n";

TEST(LaboratoryFile, HoldsWhatIsWritten) {
  const auto spec =
      parse_laboratory_file(std::string(kSensors) +
                                "[time]\ncolumn = \"t\"\nunit = \"us\"\n[source]\nduration = \"8 us\"\npolarity = \"negative\"\n"
                                "[filter]\nlow = \"50 kHz\"\nhigh = 2e6\n[material]\ndensity = 2400\nwave = \"shear\"\n",
                            "s.toml");
  ASSERT_TRUE(spec) << to_string(spec.violations);
  ASSERT_EQ(spec->sensors.size(), 2u);
  EXPECT_EQ(spec->sensors[0].column, "a");
  EXPECT_EQ(spec->sensors[0].position, 12e-3);
  EXPECT_EQ(spec->sensors[1].position, 22e-3);
  EXPECT_EQ(spec->time_column, "t");
  EXPECT_EQ(spec->time_unit, 1e-6);
  EXPECT_EQ(spec->options.source_duration, 8e-6);
  EXPECT_EQ(spec->options.polarity, Polarity::negative);
  EXPECT_EQ(spec->options.band->low, 50e3);
  EXPECT_EQ(spec->options.band->high, 2e6);
  EXPECT_EQ(spec->options.density, 2400.0);
  EXPECT_EQ(spec->options.wave, LaboratoryWave::shear);
}

TEST(LaboratoryFile, HasDefaults) {
  const auto spec = parse_laboratory_file(std::string(kSensors) + "[source]\npolarity = \"auto\"\n[filter]\nhigh = \"1 MHz\"\n", "s.toml");
  ASSERT_TRUE(spec) << to_string(spec.violations);
  EXPECT_EQ(spec->time_column, "time");
  EXPECT_EQ(spec->time_unit, 1.0);
  EXPECT_FALSE(spec->options.polarity || spec->options.source_duration || spec->options.density || spec->options.wave);
  EXPECT_EQ(spec->options.band->low, 0.0);
}

TEST(LaboratoryFile, SaysWhatIsWrongAndWhere) {
  const auto wrong = [](const std::string& more) {
    const auto spec = parse_laboratory_file(std::string(kSensors) + more, "s.toml");
    return spec ? std::string("nothing") : to_string(spec.violations);
  };
  EXPECT_THAT(wrong("[tme]\nunit = \"us\"\n"), HasSubstr("s.toml:7: tme: unknown table; did you mean time?"));
  EXPECT_THAT(wrong("[time]\nunits = \"us\"\n"), HasSubstr("s.toml:8: time.units = \"us\": unknown key; did you mean unit?"));
  EXPECT_THAT(wrong("[time]\nunit = \"hours\"\n"), HasSubstr("time.unit"));
  EXPECT_THAT(wrong("[source]\nduration = \"8 mm\"\n"), HasSubstr("is a unit of length, but a time is expected"));
  EXPECT_THAT(wrong("[source]\nduration = -1\n"), HasSubstr("must be greater than 0"));
  EXPECT_THAT(wrong("[filter]\nlow = \"2 MHz\"\nhigh = \"50 kHz\"\n"), HasSubstr("low is not below high; swap them"));
  EXPECT_THAT(wrong("[material]\ndensity = 2400\n"), HasSubstr("density without wave"));
  EXPECT_THAT(wrong("[material]\nwave = \"p\"\n"), HasSubstr("wave without density"));
  EXPECT_THAT(wrong("[[sensor]]\ncolumn = \"a\"\nposition = 1\n"), HasSubstr("s.toml:7: sensor.column = a: is there twice"));
  EXPECT_THAT(wrong("[[sensor]]\ncolumn = \"c\"\nposition = \"12 mm\"\n"), HasSubstr("is that of a, too"));
  EXPECT_THAT(wrong("[[sensor]]\ncolumn = \"c\"\n"), HasSubstr("position is missing"));
  EXPECT_THAT(wrong("[[sensor]]\nposition = 1\n"), HasSubstr("column is missing"));
  EXPECT_THAT(wrong("[[sensors]]\ncolumn = \"c\"\nposition = 1\n"), HasSubstr("did you mean sensor?"));
  EXPECT_THAT(wrong("[[time]]\nunit = \"s\"\n"), HasSubstr("write [time]"));
  EXPECT_THAT(wrong("[time\n"), HasSubstr("s.toml:7"));
  for (const char* text : {"", "title = 3\n", "[sensor]\ncolumn = \"a\"\nposition = 1\n", "[[sensor]]\ncolumn = \"a\"\nposition = 1\n",
                           "sensor = 1\n", "[[sensor.inner]]\ncolumn = \"a\"\n"})
    EXPECT_FALSE(parse_laboratory_file(text, "s.toml")) << text;
}

}  // namespace
}  // namespace ddem::harness
