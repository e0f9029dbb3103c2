// What users and their scripts read: JSON, CSV and HDF5 of a run, moduli, packings.

#include "harness/io/hdf5.h"
#include "harness/io/json.h"
#include "harness/io/signals_csv.h"
#include "harness/references/effective_moduli.h"
#include "tests/harness/cli/program.h"

namespace ddem::harness::test {
namespace {

using testing::Contains;
using testing::HasSubstr;

class Results : public Cli {
 protected:
  Json json_of(const std::vector<std::string>& arguments) const {
    const auto run = ddem(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.standard_error;
    return Json::parse(run.standard_output, nullptr, false);
  }
};

void expect_keys(const Json& json, const std::vector<std::string>& keys) {
  ASSERT_TRUE(json.is_object()) << json;
  for (const std::string& key : keys) EXPECT_TRUE(json.contains(key)) << key;
}

TEST_F(Results, JsonOfARun) {
  write("scene.toml", small_scene());
  const Json json = json_of({"run", path("scene.toml"), "--json"});
  expect_keys(json,
              {"status", "bulk_density", "critical_time_step", "time_step", "steps", "wall_seconds", "bonds",
               "nanoseconds_per_bond_step", "energy_drift", "wave_speed", "wave_speed_stddev", "pairs"});
  EXPECT_EQ(json["status"], "ok");
  // 8 x 29 bonds along the rows, 8 x (2 x 30 - 1) between neighbouring rows.
  EXPECT_EQ(json["bonds"], 8 * 29 + 8 * 59);
  ASSERT_EQ(json["pairs"].size(), 3u);
  for (const Json& pair : json["pairs"]) {
    expect_keys(pair, {"from", "to", "distance", "delay", "speed"});
    // Peak to peak, apart from how numbers are rounded.
    EXPECT_NEAR(pair["speed"].get<double>() * pair["delay"].get<double>() / pair["distance"].get<double>(),
                1.0, 1e-12);
  }
}

TEST_F(Results, SignalsAsCsv) {
  write("scene.toml", with_table(replaced(small_scene(), "pairs = 3", "discs = [12, 40]"),
                                 "[time]\nsteps = 20\nsample_every = 5"));
  ASSERT_EQ(ddem({"run", path("scene.toml"), "--signals", path("new.csv")}).exit_code, 0);
  EXPECT_THAT(
      read("new.csv"),
      testing::StartsWith("time,disc12_ux,disc12_uy,disc12_theta,disc40_ux,disc40_uy,disc40_theta\n0,"));
  EXPECT_EQ(read_signals_csv(in_folder("new.csv")).time.size(), 5u);
}

TEST_F(Results, Hdf5HasTheSameSignalsAndItsProvenance) {
  write("scene.toml", small_scene());
  ASSERT_EQ(ddem({"run", path("scene.toml"), "--signals", path("new.csv"), "-o", path("new.h5")}).exit_code,
            0);
  const SignalTable table = read_signals_csv(in_folder("new.csv"));
  const Hdf5File file = Hdf5File::open(in_folder("new.h5"));
  const Hdf5Group root = file.root();
  EXPECT_EQ(root.string_attribute("scene"), small_scene());
  for (const char* name : {"version", "commit", "compiler", "processor"})
    EXPECT_NE(root.string_attribute(name), "") << name;
  const Hdf5Group signals = root.group("signals");
  EXPECT_EQ(signals.read_doubles("time").values, table.time);
  EXPECT_EQ(signals.names().size(), 1 + table.names.size());
  for (std::size_t c = 0; c < table.names.size(); ++c) {
    EXPECT_EQ(signals.read_doubles(table.names[c]).values, table.channels[c]) << table.names[c];
  }
}

TEST_F(Results, Hdf5HasEnergiesAndFields) {
  write("scene.toml", with_table(small_scene(), "[deformation]\nscheme = \"implicit\"\ncorrection = \"full\"\n"
                                                "young_modulus = 4e10\npoisson_ratio = 0.3"));
  ASSERT_EQ(ddem({"run", path("scene.toml"), "-o", path("new.h5"), "--snapshots", "3"}).exit_code, 0);
  const Hdf5File file = Hdf5File::open(in_folder("new.h5"));
  const Hdf5Group energy = file.root().group("energy"), fields = file.root().group("fields");
  const std::size_t samples = energy.read_doubles("time").values.size();
  EXPECT_GE(samples, 200u);
  for (const char* name : {"kinetic", "contact", "particle", "invariant"}) {
    EXPECT_EQ(energy.read_doubles(name).values.size(), samples) << name;
  }
  for (const char* name : {"displacement_x", "rotation", "velocity_y", "stress_xy", "strain_xx"}) {
    EXPECT_EQ(fields.read_doubles(name).shape, (std::vector<std::size_t>{3, 240})) << name;
  }
  // The law of the disc ties its strain to its stress: eps_xx = (s_xx - nu s_yy)/E_p, to the tolerance of the strains.
  const auto xx = fields.read_doubles("stress_xx").values, yy = fields.read_doubles("stress_yy").values,
             exx = fields.read_doubles("strain_xx").values;
  double worst = 0.0, largest = 0.0;
  for (std::size_t k = 0; k < xx.size(); ++k) {
    worst = std::max(worst, std::abs(exx[k] - (xx[k] - 0.3 * yy[k]) / 4e10));
    largest = std::max(largest, std::abs(exx[k]));
  }
  EXPECT_GT(largest, 0.0);
  EXPECT_LT(worst, 1e-2 * largest);
}

TEST_F(Results, ContactModulusOfEqualDiscsIsAUniformStiffness) {
  // k_n = E_c 2 r r/(r + r) = E_c r: the same run, but for one rounding of the product.
  write("uniform.toml", small_scene());
  write("modulus.toml", replaced(small_scene(), "normal_stiffness = 1e10", "contact_modulus = 1e14"));
  const Json a = json_of({"run", path("uniform.toml"), "--json"}), b = json_of({"run", path("modulus.toml"), "--json"});
  EXPECT_NEAR(b["wave_speed"].get<double>() / a["wave_speed"].get<double>(), 1.0, 1e-10);
  EXPECT_NEAR(b["critical_time_step"].get<double>() / a["critical_time_step"].get<double>(), 1.0, 1e-10);
}

TEST_F(Results, Hdf5OfARandomPackingHasItsSeed) {
  const std::string scene = std::string(DDEM_SCENES) + "/bar_dem.toml";
  ASSERT_EQ(ddem({"run", scene, "-o", path("new.h5")}).exit_code, 0);
  EXPECT_EQ(Hdf5File::open(in_folder("new.h5")).root().int_attribute("seed"), 1);
}

TEST_F(Results, AnotherRunReplacesTheFirst) {
  write("scene.toml", small_scene());
  write("new.csv", "time,disc3_ux,disc3_uy,disc3_theta\n0,0,0,0\n");
  ASSERT_EQ(ddem({"run", path("scene.toml"), "--signals", path("new.csv")}).exit_code, 0);
  EXPECT_THAT(read("new.csv"), testing::Not(testing::HasSubstr("disc3_")));
  EXPECT_THAT(read("new.csv"), testing::StartsWith("time,"));
  EXPECT_EQ(contents().size(), 2u) << "nothing else beside the scene and its result";
}

/// The lattice's E, G and nu in closed form: exact, so only round-off (1e-10) is left.
void expect_moduli(const Json& json, const references::PlaneModuli& exact) {
  expect_keys(json, {"stiffness", "discs", "bonds", "coordination", "solid_fraction", "bulk_density",
                     "young_modulus", "shear_modulus", "bulk_modulus", "poisson_ratio", "bar_velocity",
                     "shear_velocity", "p_velocity"});
  const auto constants = references::plane_constants(exact);
  EXPECT_NEAR(json["young_modulus"].get<double>() / constants.young_modulus, 1.0, 1e-10);
  EXPECT_NEAR(json["shear_modulus"].get<double>() / exact.shear, 1.0, 1e-10);
  EXPECT_NEAR(json["bulk_modulus"].get<double>() / exact.bulk, 1.0, 1e-10);
  EXPECT_NEAR(json["poisson_ratio"].get<double>(), constants.poisson_ratio, 1e-10);
  EXPECT_NEAR(json["bar_velocity"].get<double>(),
              std::sqrt(constants.young_modulus / json["bulk_density"].get<double>()), 1e-6);
}

constexpr references::Contact kContact{1e10, 0.25};

TEST_F(Results, ModuliOfTheInfiniteLattice) {
  write("scene.toml", replaced(small_scene(), "rows = 8", "rows = 8\nperiodic = \"xy\""));
  const Json json = json_of({"moduli", path("scene.toml"), "--json"});
  expect_moduli(json, references::effective_moduli(references::ContactModel::dem,
                                                   references::hexagonal_fabric(), kContact, {}));
  EXPECT_EQ(json["discs"], 240);
  EXPECT_EQ(json["bonds"], 720);
}

TEST_F(Results, ModuliOfTheInfiniteLatticeOfDeformableDiscs) {
  const Json json = json_of({"moduli", std::string(DDEM_SCENES) + "/moduli_cell.toml", "--json"});
  expect_moduli(
      json, references::effective_moduli(references::ContactModel::ddem_full, references::hexagonal_fabric(),
                                         kContact, {{4e10, 0.3}, 1.0}));
}

TEST_F(Results, APackingComesBackThroughItsFile) {
  write("scene.toml", small_scene());
  ASSERT_EQ(ddem({"pack", path("scene.toml"), "-o", path("discs.csv")}).exit_code, 0);
  write("again.toml", file_scene());
  ASSERT_EQ(ddem({"run", path("scene.toml"), "--signals", path("first.csv")}).exit_code, 0);
  ASSERT_EQ(ddem({"run", path("again.toml"), "--signals", path("second.csv")}).exit_code, 0);
  const SignalTable first = read_signals_csv(in_folder("first.csv"));
  const SignalTable second = read_signals_csv(in_folder("second.csv"));
  ASSERT_EQ(first.names, second.names);
  ASSERT_EQ(first.time.size(), second.time.size());
  // The period in y is written with 17 digits, so that bonds through it differ by round-off: 1e-12 of the
  // amplitude, some hundred steps.
  for (std::size_t c = 0; c < first.names.size(); ++c) {
    for (std::size_t n = 0; n < first.time.size(); ++n)
      ASSERT_NEAR(first.channels[c][n], second.channels[c][n], 1e-6 * 1e-9);
  }
  ASSERT_EQ(ddem({"pack", path("again.toml"), "-o", path("discs_again.csv")}).exit_code, 0);
  EXPECT_EQ(read("discs.csv"), read("discs_again.csv"));
}

#ifdef DDEM_HAS_FEM
TEST_F(Results, ContinuumOfTheSameStrip) {
  write("scene.toml", with_table(small_scene(), "[continuum]\ndegree = 2\nelements = [30, 7]"));
  const Json json =
      json_of({"fem", path("scene.toml"), "--json", "--signals", path("new.csv"), "-o", path("new.h5")});
  expect_keys(json, {"degree", "elements", "dofs", "critical_time_step", "time_step", "steps",
                     "solve_seconds", "wave_speed", "pairs"});
  EXPECT_EQ(json["degree"], 2);
  // Periodic in y: 61 x 14 nodes, two displacements each; or with the seam's nodes counted twice.
  EXPECT_THAT((std::vector<int>{61 * 14 * 2, 61 * 15 * 2}), Contains(json["dofs"].get<int>()));
  const SignalTable table = read_signals_csv(in_folder("new.csv"));
  EXPECT_EQ(table.names.front(), "p0_ux");
  EXPECT_EQ(Hdf5File::open(in_folder("new.h5")).root().group("signals").read_doubles("p0_ux").values,
            table.channels.front());
}
#endif

}  // namespace
}  // namespace ddem::harness::test
