// A wave speed is a number only where there was a wave. Every sweep here ends each run with a number that is right, or with
// null and a reason that names what to change.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "harness/io/json.h"
#include "tests/harness/cli/program.h"

namespace ddem::harness::test {
namespace {

using testing::HasSubstr;

#ifdef DDEM_HAS_FEM
const std::vector<std::string> kCommands = {"run", "fem"};
#else
const std::vector<std::string> kCommands = {"run"};
#endif

class WaveNumber : public Cli {
 protected:
  /// small_scene(), twice as long, with another load and [time].
  static std::string scene(const std::string& load, const std::string& time = "", const std::string& contact = "") {
    std::string text = replaced(small_scene(), "columns = 30", "columns = 60");
    text.replace(text.find("[initial]"), text.find("[probes]") - text.find("[initial]"),
                 load + "\n[time]\n" + time + "\n[continuum]\nyoung_modulus = 1e10\npoisson_ratio = 0.25\ndensity = 1800\nelements = [60, 7]\n");
    return replaced(text, "stiffness_ratio = 0.25", "stiffness_ratio = 0.25\n" + contact);
  }
  static std::string gaussian(double width, double center, double amplitude = 1e-7) {
    return fmt::format("[initial]\nwave = \"shear\"\nshape = \"gaussian\"\nwidth = {}\ncenter = {}\namplitude = {}", width, center, amplitude);
  }
  static std::string drive(double duration, double amplitude = 1e-7) {
    return fmt::format("[drive]\nwave = \"shear\"\nduration = {}\namplitude = {}", duration, amplitude);
  }

  Json json_of(const std::string& command, const std::string& text) const {
    write("scene.toml", text);
    const auto run = ddem({command, path("scene.toml"), "--json"});
    EXPECT_EQ(run.exit_code, 0) << run.standard_error;
    return Json::parse(run.standard_output, nullptr, false);
  }

  /// The speed, or none with a reason beside it; the keys are the same.
  static std::optional<double> speed(const Json& j) {
    for (const char* key : {"wave_speed", "wave_speed_stddev", "wave_speed_by_centroid", "wave_speed_by_correlation"}) {
      EXPECT_TRUE(j.contains(key) && (j[key].is_number() || j[key].is_null())) << key << ": " << j;
      EXPECT_EQ(j[std::string(key) + "_status"] == "ok", j[key].is_number()) << key << ": " << j;
    }
    for (const Json& pair : j["pairs"]) EXPECT_EQ(pair["status"] == "ok", pair["speed"].is_number() && pair["delay"].is_number()) << pair;
    return j["wave_speed"].is_number() ? std::optional(j["wave_speed"].get<double>()) : std::nullopt;
  }
  static std::string reason(const Json& j) { return j["wave_speed_status"]; }
};

TEST_F(WaveNumber, IsTheSameForEitherSignOfTheSource) {
  for (const char* wave : {"longitudinal", "shear"}) {
    for (const char* load : {"[initial]\nshape = \"column\"", "[initial]\nshape = \"cosine\"\nwidth = \"1 mm\"",
                             "[initial]\nshape = \"gaussian\"\nwidth = \"0.4 mm\"", "[drive]\nduration = \"1 us\""}) {
      for (const std::string& command : kCommands) {
        const auto signed_scene = [&](const char* amplitude) { return scene(fmt::format("{}\nwave = \"{}\"\namplitude = \"{}\"", load, wave, amplitude)); };
        const Json plus = json_of(command, signed_scene("10 nm")), minus = json_of(command, signed_scene("-10 nm"));
        ASSERT_TRUE(speed(plus)) << command << " " << wave << " " << load << ": " << reason(plus);
        EXPECT_EQ(speed(plus), speed(minus)) << command << " " << wave << " " << load << ": " << reason(minus);
        EXPECT_EQ(plus["pairs"], minus["pairs"]);
        EXPECT_EQ(plus["wave_speed_by_centroid"], minus["wave_speed_by_centroid"]);
        EXPECT_EQ(plus["wave_speed_by_correlation"], minus["wave_speed_by_correlation"]);
      }
    }
  }
}

/// 12 mm of strip with pairs from 3 to 9 mm. Gaussians of 0.5 mm are slowed by dispersion by (k r)^2/24 < 1 %, and start where
/// they like: left of all pairs, among them, right of them, at the ends.
TEST_F(WaveNumber, DoesNotDependOnWhereThePulseStarts) {
  for (const std::string& command : kCommands) {
    const double right = speed(json_of(command, scene(gaussian(5e-4, 0.0)))).value();
    int numbers = 0, refusals = 0;
    for (const double center : {-2e-3, -2e-4, 2e-4, 7e-4, 1.2e-3, 1.6e-3, 2.5e-3, 4e-3, 5e-3, 6e-3, 7e-3, 8e-3, 9.5e-3, 10.5e-3, 11e-3, 11.8e-3, 14e-3}) {
      const Json j = json_of(command, scene(gaussian(5e-4, center)));
      if (const auto v = speed(j)) {
        EXPECT_NEAR(*v / right, 1.0, 0.015) << command << ", " << center;
        ++numbers;
      } else {
        EXPECT_THAT(reason(j), HasSubstr("initial.center")) << command << ", " << center;
        ++refusals;
      }
    }
    EXPECT_GE(numbers, 3) << command;
    EXPECT_GE(refusals, 5) << command;
  }
}

TEST_F(WaveNumber, DoesNotDependOnHowWideThePulseIs) {
  for (const std::string& command : kCommands) {
    const double right = speed(json_of(command, scene(gaussian(8e-4, 0.0)))).value();
    for (const double width : {5e-4, 9e-4, 1.05e-3, 1.5e-3, 2.2e-3, 3e-3, 3.8e-3, 6e-3, 2e-2}) {
      const Json j = json_of(command, scene(gaussian(width, 0.0)));
      if (const auto v = speed(j)) {
        EXPECT_NEAR(*v / right, 1.0, 0.015) << command << ", " << width;
      } else {
        EXPECT_THAT(reason(j), HasSubstr("initial.width")) << command << ", " << width;
        EXPECT_GT(width, 9.5e-4) << command;
      }
    }
    for (const double duration : {1e-6, 2e-6, 4e-6, 6e-6, 8e-6, 1e-5, 3e-5}) {
      const Json j = json_of(command, scene(drive(duration)));
      if (const auto v = speed(j)) {
        EXPECT_NEAR(*v / right, 1.0, 0.015) << command << ", " << duration;
      } else {
        EXPECT_THAT(reason(j), HasSubstr("drive.duration")) << command << ", " << duration;
        EXPECT_GT(duration, 3e-6) << command;
      }
    }
  }
}

/// What is refused says how close samples must stand, and so they give a number.
TEST_F(WaveNumber, NeedsSamplesInThePulse) {
  const std::string column = "[initial]\nwave = \"shear\"\namplitude = 1e-7";
  for (const std::string& load : {drive(1.5e-6), gaussian(5e-4, 0.0), column}) {
    const auto sampled = [&](int every) { return json_of("run", scene(load, fmt::format("sample_every = {}", every))); };
    const double right = speed(sampled(1)).value();
    int refusals = 0;
    for (const int every : {2, 4, 6, 8, 10, 14, 20, 30, 50, 80, 120, 200, 1000}) {
      const Json j = sampled(every);
      if (const auto v = speed(j)) {
        EXPECT_NEAR(*v / right, 1.0, 2e-3) << load << ", " << every;
        continue;
      }
      ++refusals;
      const std::string key = "time.sample_every = ";
      if (load == column && reason(j).find(key) == std::string::npos) continue;  // too coarse to see even how wide it is
      ASSERT_THAT(reason(j), HasSubstr(key)) << load << ", " << every;
      const int enough = std::stoi(reason(j).substr(reason(j).find(key) + key.size()));
      EXPECT_LT(enough, every);
      if (every == 120) {
        EXPECT_TRUE(speed(sampled(enough))) << load << ", " << enough;
      }
    }
    EXPECT_GE(refusals, 4) << load;
  }
}

/// The step here is 15 ns. A drive of two steps and less is refused, of a few more warned of, and exact signals need no steps.
TEST_F(WaveNumber, NeedsStepsInTheDrive) {
  for (const double steps : {0.3, 0.9, 1.0, 1.35, 1.9, 2.0}) {
    write("scene.toml", scene(drive(steps * 15e-9), "step = 15e-9\nend = 1e-6"));
    const auto run = ddem({"run", path("scene.toml"), "--json"});
    EXPECT_EQ(run.exit_code, 2) << steps;
    EXPECT_THAT(run.standard_error, HasSubstr("drive.duration")) << steps;
    EXPECT_EQ(ddem({"run", path("scene.toml")}).standard_output, "");
    const Json exact = json_of("run", scene(drive(steps * 15e-9), "step = 15e-9\nend = 1e-6\nintegrator = \"exact\""));
    EXPECT_FALSE(speed(exact));
  }
  for (const double steps : {2.5, 5.0, 40.0, 200.0}) {
    const Json j = json_of("run", scene(drive(steps * 15e-9), "step = 15e-9"));
    EXPECT_EQ(j["warnings"].dump().find("hardly sampled") != std::string::npos, steps < 7.0) << steps << ": " << j["warnings"];
    EXPECT_EQ(speed(j).has_value(), steps > 100.0 || (steps > 20.0 && speed(j).has_value())) << steps;
  }
}

/// A radius is 0.1 mm. Linear kinematics errs by 0.2 % at a tenth of it: a warning; beyond the radius an error.
TEST_F(WaveNumber, NeedsSmallDisplacementsInLinearKinematics) {
  const auto loads = [](double amplitude) {
    return std::vector<std::string>{drive(1e-6, amplitude), gaussian(5e-4, 0.0, amplitude), fmt::format("[initial]\nwave = \"shear\"\namplitude = {}", amplitude)};
  };
  const std::string off = "new_contacts = \"off\"";
  for (const double amplitude : {1e-6, -4e-6, 2e-5, -9e-5}) {
    for (const std::string& load : loads(amplitude)) {
      const Json j = json_of("run", scene(load, "steps = 5", off));
      EXPECT_EQ(j["warnings"].dump().find("linear kinematics") != std::string::npos, std::abs(amplitude) > 5e-6) << load << ": " << j["warnings"];
      const Json nonlinear = json_of("run", scene(load, "steps = 5", off + "\nkinematics = \"nonlinear\""));
      EXPECT_EQ(nonlinear["warnings"].dump().find("linear kinematics"), std::string::npos) << load;
    }
  }
  for (const double amplitude : {1.1e-4, -1e-3, 1e-2}) {
    for (const std::string& load : loads(amplitude)) {
      write("scene.toml", scene(load, "steps = 5", off));
      const auto run = ddem({"run", path("scene.toml")});
      EXPECT_EQ(run.exit_code, 2) << load;
      EXPECT_THAT(run.standard_error, HasSubstr(".amplitude")) << load;
    }
  }
}

/// A body that moves as a whole stays as it is; one that is torn apart does not.
TEST_F(WaveNumber, TellsMotionFromDeformationInStates) {
  const auto state = [&](double shift, double stretch) {
    std::string text = "ux,uy,theta\n";
    for (int d = 0; d < 480; ++d) text += fmt::format("{},0,0\n", shift + stretch * (d % 60));
    write("u0.csv", text);
    write("scene.toml", replaced(scene("[initial]\ndisplacement = \"u0.csv\"", "steps = 5", "new_contacts = \"off\""), "[boundary]\n", "[boundary]\nright = \"free\"\n"));
    return ddem({"run", path("scene.toml"), "--json"});
  };
  const auto moved = state(3e-3, 0.0);
  EXPECT_EQ(moved.exit_code, 0) << moved.standard_error;
  EXPECT_EQ(moved.standard_output.find("linear kinematics"), std::string::npos);
  const auto stretched = state(0.0, 2e-5);
  EXPECT_THAT(stretched.standard_output, HasSubstr("linear kinematics"));
  const auto torn = state(0.0, 2e-4);
  EXPECT_EQ(torn.exit_code, 2);
  EXPECT_THAT(torn.standard_error, HasSubstr("initial.displacement"));
}

/// Above the critical step a run is unstable, whether or not it is seen to be: a speed is that of the stable run, or none.
TEST_F(WaveNumber, IsNoneWhereTheRunGrows) {
  const std::string column = "[initial]\nwave = \"shear\"\namplitude = 1e-8";
  for (const std::string& load : {column, drive(2e-6, 1e-8)}) {
    const double right = speed(json_of("run", scene(load, "step_fraction = 0.99"))).value();
    int refusals = 0;
    for (const double fraction : {1.00001, 1.0003, 1.001, 1.002, 1.005, 1.01, 1.02, 1.05}) {
      write("scene.toml", scene(load, fmt::format("step_fraction = {}\nallow_above_critical = true", fraction)));
      const auto run = ddem({"run", path("scene.toml"), "--json"});
      if (run.exit_code == 3) continue;  // seen to have diverged
      const Json j = Json::parse(run.standard_output, nullptr, false);
      if (const auto v = speed(j)) {
        EXPECT_EQ(j["status"], "ok");
        EXPECT_NEAR(*v / right, 1.0, 0.02) << load << ", " << fraction;
      } else {
        ++refusals;
        EXPECT_EQ(j["status"], "unstable");
        EXPECT_THAT(reason(j), HasSubstr("unstable")) << load << ", " << fraction;
      }
    }
    EXPECT_GE(refusals, 1) << load;
  }
}

/// A campaign's criterion on what was not measured is an error with that reason.
TEST_F(WaveNumber, OfACampaignIsARefusalWithItsReason) {
  write("scene.toml", scene(gaussian(4e-4, 6e-3)));
  write("cases.toml", "[[case]]\nid = \"across\"\ntitle = \"a source between its probes\"\nscene = \"scene.toml\"\n"
                      "[[case.criterion]]\nmetric = \"wave_speed\"\nlower = 1\nupper = 1e5\nunit = \"m/s\"\nderivation = \"any\"\n");
  const auto run = ddem({"validate", path("cases.toml"), "-o", path("out")});
  EXPECT_EQ(run.exit_code, 1) << run.standard_error;
  EXPECT_THAT(read("out/summary.json"), HasSubstr("between the probes"));
  EXPECT_THAT(read("out/summary.json"), HasSubstr("Warning: initial.width: the pulse is short"));  // and what its run warns of
}

}  // namespace
}  // namespace ddem::harness::test
