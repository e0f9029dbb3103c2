#pragma once
// A campaign of six cases of milliseconds each, run by the built program.

#include "harness/io/json.h"
#include "tests/harness/cli/program.h"

namespace ddem::harness::test {

inline constexpr const char* kSmallCampaign = R"([[case]]
id = "small"
scene = "scene.toml"
[case.matrix]
"contact.stiffness_ratio" = [0.1, 0.3, 0.5]
"material.density" = [1000.0, "2000 kg/m3"]
[[case.criterion]]
metric = "wave_speed"
target = "static.p_velocity"
lower = -0.5
upper = 0.5
unit = "m/s"
derivation = "anything near"
[[case.criterion]]
metric = "energy_drift"
upper = 1e-10
derivation = "leapfrog keeps its invariant to round-off"
)";

class SmallCampaign : public Cli {
 protected:
  void SetUp() override {
    write("scene.toml", small_scene());
    write("campaign.toml", kSmallCampaign);
  }

  SubprocessResult validate(const std::string& folder, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {"validate", path("campaign.toml"), "-o", path(folder)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return ddem(arguments);
  }

  /// What may not depend on how a campaign was run.
  std::string outcome(const std::string& folder) const {
    Json j = read_json(in_folder(folder) / "summary.json");
    j.erase("wall_seconds");
    j["provenance"].erase("time");
    return to_text(j);
  }

  std::vector<std::string> cases_in(const std::string& folder) const {
    std::vector<std::string> ids;
    const Json summary = read_json(in_folder(folder) / "summary.json");
    for (const Json& c : summary["cases"]) ids.push_back(c["id"]);
    return ids;
  }

  /// A line of a shell, in the test's folder, with the built program as `ddem`.
  SubprocessResult shell(const std::string& line) const {
    const std::string program = std::filesystem::path(DDEM_PROGRAM).parent_path().string();
    return run_program("/bin/bash", {"-c", "cd '" + path("") + "' && PATH='" + program + "':$PATH && " + line});
  }
};

}  // namespace ddem::harness::test
