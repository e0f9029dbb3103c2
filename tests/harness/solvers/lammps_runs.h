#pragma once
// Scripts of ddem export --format lammps, as they are and edited, run by ddem-lammps.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/io/subprocess.h"
#include "harness/io/temporary_folder.h"
#include "harness/run/dem_run.h"

namespace ddem::harness::test {

/// Where ddem-lammps was not built, its tests are skipped.
inline constexpr const char* kLammps = DDEM_LAMMPS;

/// Lines of tables of a random strip of 200 discs.
struct StripScene {
  double ratio = 0.25;
  std::string contact = "normal_stiffness = 1e10\n";  ///< further lines of [contact]
  std::string deformation = {};                       ///< the table
  std::string load = "[initial]\nwave = \"longitudinal\"\nshape = \"column\"\namplitude = \"1 um\"\n";
  std::string edges = "free";
  std::string thickness = "1.0";
  double step_fraction = 0.2;
  int steps = 400, sample_every = 20;
  std::string assembly = "packing = \"random\"\nlength = \"7 mm\"\nwidth = \"1.4 mm\"\ndiscs = 200\nseed = 3\n";
  std::string new_contacts = "off";
  std::string discs = "0, 3, 11, 40, 77, 90, 123, 150, 171, 199";
};
std::string lagged(const std::string& correction, const std::string& more = "");
std::string implicit(const std::string& correction);
/// Of the left edge, up and down.
inline constexpr const char* kShearDrive = "[drive]\nwave = \"shear\"\nduration = \"1 us\"\namplitude = \"1 um\"\n";

PreparedRun prepared(const StripScene& scene);

/// With new contacts.
StripScene touching(const std::string& deformation = "", const std::string& contact = "", const char* edges = "free");
/// Every fourth bond is cut, so that there are pairs with a gap of nearly nothing all over the strip, and discs are shaken by
/// velocities at random: contacts close and open everywhere.
PreparedRun shaken(const StripScene& scene);

/// ux, uy, theta of a scene's discs over time.
struct Motion {
  std::vector<double> u, theta;
};
/// Of the largest there is.
double difference(const std::vector<double>& a, const std::vector<double>& b);

Motion by_builtin(const PreparedRun& run);

using Edit = std::function<std::string(std::string script)>;
/// The only `old` replaced; a test that replaces nothing fails.
std::string replaced(std::string text, const std::string& old, const std::string& by);

class LammpsFolder {
 public:
  explicit LammpsFolder(const PreparedRun& run);

  /// Of in.strip, edited, by so many ranks.
  SubprocessResult run(int ranks = 1, const Edit& edit = {}, const std::string& lammps = kLammps) const;
  /// What the last run left.
  Motion motion() const;
  std::string read(const std::string& name) const;
  const std::filesystem::path& path() const { return folder_.path(); }

 private:
  const PreparedRun& run_;
  TemporaryFolder folder_{"ddem-lammps-test"};
};

/// Runs, and expects success.
Motion by_lammps(const PreparedRun& run, int ranks = 1, const Edit& edit = {});

std::string newton_on(std::string script);

/// Step and these columns of thermo_style, every ten steps; `before`: further commands, `edit`: of the script.
std::vector<std::vector<double>> thermo(const PreparedRun& run, int ranks, const std::string& before, const std::string& columns, const Edit& edit = {});

class OnLammps : public testing::Test {
 protected:
  void SetUp() override;
};

}  // namespace ddem::harness::test
