// ddem measure from outside: files of a laboratory, words and JSON, refusals.

#include <fmt/format.h>

#include <cmath>

#include "harness/io/json.h"
#include "tests/harness/cli/program.h"
#include "tests/harness/measure/synthetic.h"

namespace ddem::harness::test {
namespace {

using testing::HasSubstr;

constexpr double kSpeed = 2500.0;  // m/s

/// Sensors 12, 22 and 42 mm from the source, a sample every 0.1 us, noise of 1 %.
std::string shots(double unit, char separator = ',', const std::string& time = "time", double pulse = 1.0) {
  std::string text = fmt::format("{}{}near{}middle{}far\n", time, separator, separator, separator);
  synthetic::Noise noise(11);
  for (int n = 0; n < 600; ++n) {
    const double t = 1e-7 * n;
    text += fmt::format("{}", t / unit);
    for (const double x : {12e-3, 22e-3, 42e-3})
      text += fmt::format("{}{}", separator, pulse * synthetic::sin2(t, 10e-6 + x / kSpeed, 4e-6) + 0.01 * noise());
    text += '\n';
  }
  return text;
}

constexpr const char* kSensors =
    "[[sensor]]\ncolumn = \"near\"\nposition = \"12 mm\"\n[[sensor]]\ncolumn = \"middle\"\nposition = \"22 mm\"\n"
    "[[sensor]]\ncolumn = \"far\"\nposition = \"42 mm\"\n";

class Measure : public Cli {
 protected:
  SubprocessResult measure(std::vector<std::string> more) const {
    more.insert(more.begin(), {"measure", path("shots.csv")});
    return ddem(more);
  }
  Json json_of(std::vector<std::string> more) const {
    more.push_back("--json");
    const auto run = measure(more);
    EXPECT_EQ(run.exit_code, 0) << run.standard_error;
    return Json::parse(run.standard_output, nullptr, false);
  }
  void expect_wrong(const std::vector<std::string>& more, const std::string& what) const {
    const auto run = measure(more);
    EXPECT_EQ(run.exit_code, 2) << testing::PrintToString(more) << run.standard_output;
    EXPECT_EQ(run.standard_output, "");
    EXPECT_THAT(run.standard_error, HasSubstr(what)) << testing::PrintToString(more);
  }
};

TEST_F(Measure, TwoColumnsAndTheirDistance) {
  write("shots.csv", shots(1.0));
  const Json j = json_of({"--distance", "10 mm"});
  EXPECT_EQ(j["status"], "ok");
  EXPECT_NEAR(j["time_step"].get<double>(), 1e-7, 1e-12);
  ASSERT_EQ(j["sensors"].size(), 2u);
  EXPECT_EQ(j["sensors"][0]["name"], "near");
  EXPECT_NEAR(j["sensors"][0]["noise"].get<double>(), 0.01, 0.003);
  for (const char* mark : {"peak", "first_break", "centroid", "correlation"}) {
    const Json& speed = j["speed"][mark];
    EXPECT_EQ(speed["status"], "ok") << mark;
    EXPECT_LT(std::abs(speed["speed"].get<double>() - kSpeed), 4.0 * speed["stddev"].get<double>()) << mark;
    EXPECT_LT(speed["stddev"].get<double>(), 0.01 * kSpeed) << mark;
    EXPECT_EQ(j["pairs"][0][mark]["speed"], speed["speed"]) << mark;
  }
  EXPECT_FALSE(j.contains("modulus"));
  const auto text = measure({"--distance", "10 mm", "--pick", "peak"});
  EXPECT_EQ(text.exit_code, 0);
  EXPECT_THAT(text.standard_output, HasSubstr("near to middle, 10 mm"));
  EXPECT_THAT(text.standard_output, HasSubstr("peak"));
  EXPECT_THAT(text.standard_output, testing::Not(HasSubstr("centroid")));
}

TEST_F(Measure, ColumnsUnitsAndSeparators) {
  write("shots.csv", shots(1e-6, ';', "t [us]"));
  const Json j = json_of({"--distance", "30 mm", "--columns", "near,far", "--time-column", "t [us]", "--time-unit", "us", "--density",
                          "2 g/cm3", "--wave", "p"});
  EXPECT_NEAR(j["speed"]["peak"]["speed"].get<double>() / kSpeed, 1.0, 0.01);
  EXPECT_EQ(j["modulus"]["symbol"], "M");
  const double c = j["speed"]["centroid"]["speed"].get<double>();
  EXPECT_NEAR(j["modulus"]["centroid"]["value"].get<double>() / (2000.0 * c * c), 1.0, 1e-12);
  EXPECT_THAT(measure({"--distance", "30 mm", "--columns", "near,far", "--time-column", "t [us]", "--time-unit", "us", "--density", "2000",
                       "--wave", "p"})
                  .standard_output,
              HasSubstr("M = 12."));
}

TEST_F(Measure, AFileOfPositionsSaysTheSameAsOptions) {
  write("shots.csv", shots(1e-6, ',', "t"));
  const std::string rest = "[time]\ncolumn = \"t\"\nunit = \"us\"\n";
  write("sensors.toml", kSensors + rest +
                            "[filter]\nhigh = \"1 MHz\"\n[source]\npolarity = \"positive\"\nduration = \"4 us\"\n[material]\ndensity = "
                            "2400\nwave = \"bar\"\n");
  const Json file = json_of({"--positions", path("sensors.toml")});
  EXPECT_EQ(file["pairs"].size(), 3u);
  EXPECT_EQ(file["speed"]["peak"]["pairs"], 3);
  EXPECT_NEAR(file["speed"]["peak"]["speed"].get<double>() / kSpeed, 1.0, 0.01);
  EXPECT_EQ(file["modulus"]["symbol"], "E");
  write("sensors.toml", std::string(kSensors));
  const Json options = json_of({"--positions", path("sensors.toml"), "--time-column", "t", "--time-unit", "us", "--band-pass", "0,1 MHz",
                                "--polarity", "positive", "--source-duration", "4 us", "--density", "2400", "--wave", "bar"});
  EXPECT_EQ(file, options);
}

TEST_F(Measure, WhatHasNoWaveHasNoNumber) {
  write("shots.csv", shots(1.0, ',', "time", 0.0));
  const auto run = measure({"--distance", "10 mm"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.standard_output, HasSubstr("no speed: "));
  EXPECT_THAT(run.standard_output, testing::Not(HasSubstr("m/s")));
  const auto json = measure({"--distance", "10 mm", "--json"});
  EXPECT_EQ(json.exit_code, 0);
  const Json j = Json::parse(json.standard_output, nullptr, false);
  EXPECT_NE(j["status"], "ok");
  EXPECT_TRUE(j["speed_by_peak"].is_null());
  EXPECT_NE(j["speed_by_peak_status"], "ok");
  EXPECT_TRUE(j["speed"]["peak"]["speed"].is_null());
  EXPECT_NE(j["speed"]["peak"]["status"], "ok");
  EXPECT_TRUE(j["sensors"][0]["peak"]["time"].is_null());
  EXPECT_TRUE(j["sensors"][0]["height"].is_null());
}

TEST_F(Measure, WrongUseIsExplained) {
  write("shots.csv", shots(1.0));
  write("sensors.toml", kSensors);
  expect_wrong({}, "how far apart are the sensors?");
  expect_wrong({"--distance", "10 mm", "--positions", path("sensors.toml")}, "leave one of them out");
  expect_wrong({"--positions", path("sensors.toml"), "--columns", "near,far"}, "leave it out");
  expect_wrong({"--distance", "10 mm", "--columns", "nea,far"}, "there is no column nea; did you mean near?");
  expect_wrong({"--distance", "10 mm", "--columns", "near"}, "give two different ones");
  expect_wrong({"--distance", "10 mm", "--columns", "near,near"}, "give two different ones");
  expect_wrong({"--distance", "10 mm", "--time-column", "tme"}, "did you mean time?");
  expect_wrong({"--distance", "10 s"}, "--distance 10 s: \"s\" is a unit of time");
  expect_wrong({"--distance", "-1 mm"}, "must be greater than 0");
  expect_wrong({"--distance", "10 mm", "--band-pass", "2 MHz,50 kHz"}, "write LOW,HIGH");
  expect_wrong({"--distance", "10 mm", "--band-pass", "50 kHz"}, "write LOW,HIGH");
  expect_wrong({"--distance", "10 mm", "--band-pass", "0,50 MHz"}, "hold nothing above 5000 kHz; lower it");
  expect_wrong({"--distance", "10 mm", "--density", "2400"}, "of which wave?");
  expect_wrong({"--distance", "10 mm", "--wave", "p"}, "add --density");
  expect_wrong({"--distance", "10 mm", "--wave", "love"}, "--wave");
  expect_wrong({"--positions", path("none.toml")}, "none.toml");
  write("sensors.toml", std::string(kSensors) + "[filter]\nlow = \"1 mm\"\n");
  expect_wrong({"--positions", path("sensors.toml")}, "sensors.toml:11: filter.low");
  write("shots.csv", "time,a\n0,1\n1,2\n");
  expect_wrong({"--distance", "10 mm"}, "a speed needs two sensors");
  write("shots.csv", "time,a,b\n0,1,2\n1,2,3\n2,1,1\n9,1,1\n10,1,1\n");
  expect_wrong({"--distance", "10 mm"}, "shots.csv:5: time: a gap of 7 s");
  write("shots.csv", "time,a,b\n0,1,2\n1,2,3\n1,1,1\n");
  expect_wrong({"--distance", "10 mm"}, "shots.csv:4: time: the time does not increase");
  write("shots.csv", rubbish(5000));
  EXPECT_EQ(measure({"--distance", "10 mm"}).exit_code, 2);
}

}  // namespace
}  // namespace ddem::harness::test
