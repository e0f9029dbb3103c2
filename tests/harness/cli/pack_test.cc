// ddem pack: what it reports, walls, tiles, and the cache of jammed packings.
#include <sys/stat.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <string>

#include "harness/io/atomic_file.h"
#include "harness/io/json.h"
#include "harness/model/packing_store.h"
#include "tests/harness/cli/program.h"

namespace ddem::harness::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class Pack : public Cli {
 protected:
  void SetUp() override {
    if (const char* old = std::getenv("XDG_CACHE_HOME")) old_ = old;
    ::setenv("XDG_CACHE_HOME", path("cache").c_str(), 1);
  }
  void TearDown() override {
    if (old_.empty())
      ::unsetenv("XDG_CACHE_HOME");
    else
      ::setenv("XDG_CACHE_HOME", old_.c_str(), 1);
  }

  Json packed(const std::string& lines) {
    write("scene.toml", "[assembly]\npacking = \"random\"\nlength = \"8 mm\"\nwidth = \"2 mm\"\n" + lines);
    const SubprocessResult result = ddem({"pack", path("scene.toml"), "-o", path("discs.csv"), "--json"});
    EXPECT_EQ(result.exit_code, 0) << result.standard_error;
    text_ = result.standard_error;
    return Json::parse(result.standard_output);
  }

  std::size_t files_in_cache() const {
    const fs::path folder = in_folder("cache") / "ddem";
    return fs::exists(folder) ? static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), {})) : 0;
  }

  /// All that a scene needs besides its packing.
  static std::string wave() {
    return "[material]\ndensity = 2000\n[contact]\nnormal_stiffness = 1e10\nstiffness_ratio = 0.3\n[boundary]\ntop_bottom = \"periodic\"\n"
           "[drive]\nwave = \"shear\"\nduration = \"2 us\"\namplitude = \"10 nm\"\n[time]\nsteps = 20\n[probes]\npairs = 2\n";
  }

  std::string text_;

 private:
  std::string old_;
};

/// What moves the discs, and the mesh, are nothing to a packing; for a scene's moduli they are as little.
TEST_F(Pack, NeedsNoFilesButThoseOfThePacking) {
  const std::string start = "[initial]\ndisplacement = \"later.csv\"\nvelocity = \"later.csv\"\n", scene = small_scene();
  std::string text = scene.substr(0, scene.find("[initial]")) + start + "[continuum]\nyoung_modulus = 1e10\npoisson_ratio = 0.2\ndensity = 2000\nmesh = \"later.msh\"\n";
  text += "[time]\nsteps = 5\n[probes]\ndiscs = [3]\n";
  write("scene.toml", text);
  EXPECT_EQ(ddem({"pack", path("scene.toml"), "-o", path("discs.csv")}).exit_code, 0);
  EXPECT_EQ(ddem({"moduli", path("scene.toml")}).exit_code, 0);
  EXPECT_EQ(ddem({"stability", path("scene.toml")}).exit_code, 0);
  const auto run = ddem({"run", path("scene.toml")});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.standard_error, HasSubstr("initial.displacement = \"later.csv\": there is no file"));
  EXPECT_THAT(run.standard_error, Not(HasSubstr("later.msh")));
  // The start that is made for that packing; and no output may take its place.
  std::string rest = "ux,uy,theta\n";
  for (int d = 0; d < 240; ++d) rest += "0,1e-9,0\n";
  write("later.csv", rest);
  EXPECT_EQ(ddem({"run", path("scene.toml")}).exit_code, 0);
  EXPECT_EQ(ddem({"pack", path("scene.toml"), "-o", path("later.csv")}).exit_code, 2);
  EXPECT_EQ(read("later.csv"), rest);
}

TEST_F(Pack, ReportsWhatThePackingIsLike) {
  for (const double wanted : {4.6, 5.9}) {
    for (const std::string walls : {"periodic", "flat"}) {
      const Json j = packed("discs = 330\nwalls = \"" + walls + "\"\ncoordination = " + std::to_string(wanted) + "\n");
      EXPECT_EQ(j["discs"], 330);
      EXPECT_EQ(j["length"], 8e-3);
      EXPECT_EQ(j["width"], 2e-3);
      EXPECT_NEAR(j["coordination"].get<double>(), wanted, 0.02) << walls;
      EXPECT_LT(j["network_coordination"].get<double>(), wanted);
      EXPECT_NEAR(j["porosity"].get<double>(), 0.17, 0.03);
      EXPECT_LE(j["largest_overlap"].get<double>(), 1e-3);
      EXPECT_TRUE(j["warnings"].empty());
      EXPECT_THAT(text_, HasSubstr("porosity"));
    }
  }
}

TEST_F(Pack, WarnsOfCrystals) {
  const Json j = packed("discs = 330\nradius_ratio = 1\n");
  EXPECT_EQ(j["warnings"].size(), 1u);
  EXPECT_THAT(text_, HasSubstr("discs of nearly the same size crystallise"));
}

/// The run goes on: the warning is in its results and on standard error.
TEST_F(Pack, OfEqualDiscsMakesARunWarn) {
  write("scene.toml", "[assembly]\npacking = \"random\"\nlength = \"8 mm\"\nwidth = \"2 mm\"\ndiscs = 330\nradius_ratio = 1\n" + wave());
  const SubprocessResult warned = ddem({"run", path("scene.toml"), "--json"});
  EXPECT_EQ(warned.exit_code, 0) << warned.standard_error;
  EXPECT_THAT(warned.standard_error, HasSubstr("discs of nearly the same size crystallise"));
  const auto of_crystals = [](const SubprocessResult& run) { return Json::parse(run.standard_output)["warnings"].dump().find("crystallise") != std::string::npos; };
  EXPECT_TRUE(of_crystals(warned));
  write("scene.toml", replaced(read("scene.toml"), "radius_ratio = 1\n", ""));
  const SubprocessResult silent = ddem({"run", path("scene.toml"), "--json"});
  EXPECT_EQ(silent.exit_code, 0) << silent.standard_error;
  EXPECT_FALSE(of_crystals(silent));
}

TEST_F(Pack, TilesLargeSamples) {
  const Json j = packed("discs = 28252\n");  // 28 times a prime number: small cells, quickly jammed
  EXPECT_EQ(j["discs"], 28252);
  EXPECT_EQ(j["tiles"], Json({7, 2}));
  EXPECT_EQ(j["discs_in_a_tile"], 2018);
  EXPECT_NEAR(j["coordination"].get<double>(), 5.8, 1.0 / 2018);
  EXPECT_THAT(text_, HasSubstr("copies of one periodic cell"));
  write("scene.toml", read("scene.toml") + "walls = \"flat\"\n");
  const SubprocessResult refused = ddem({"pack", path("scene.toml"), "-o", path("discs.csv")});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.standard_error, HasSubstr("or walls = \"periodic\""));
}

TEST_F(Pack, JamsOnceAndGivesTheSameBits) {
  packed("discs = 330\n");
  const std::string made = read("discs.csv");
  ASSERT_EQ(files_in_cache(), 1u);
  packed("discs = 330\n");
  EXPECT_EQ(read("discs.csv"), made);
  packed("discs = 330\nseed = 2\n");
  EXPECT_NE(read("discs.csv"), made);
  EXPECT_EQ(files_in_cache(), 2u);
  // Damaged files and a cache that cannot be written to change nothing.
  for (const auto& entry : fs::directory_iterator(in_folder("cache") / "ddem")) write_file(entry.path(), "damaged");
  packed("discs = 330\n");
  EXPECT_EQ(read("discs.csv"), made);
  fs::remove_all(in_folder("cache"));
  write("cache", "no folder");
  packed("discs = 330\n");
  EXPECT_EQ(read("discs.csv"), made);
}

TEST_F(Pack, GradingsAndPorosities) {
  write("curve.csv", "radius,passing\n1,0\n3,1\n");
  const std::string discs = "discs = 300\n";
  const Json uniform = packed(discs), sieved = packed(discs + "grading = \"sieve\"\nsieve = \"curve.csv\"\n");
  EXPECT_NEAR(uniform["largest_radius"].get<double>() / uniform["smallest_radius"].get<double>(), 1.67, 1e-12);
  // Of 300 quantiles the outermost are half a disc off the ends.
  EXPECT_NEAR(sieved["largest_radius"].get<double>() / sieved["smallest_radius"].get<double>(), 3.0, 0.1);
  EXPECT_NEAR(packed(discs + "porosity = 0.3\n")["porosity"].get<double>(), 0.3, 1e-12);
  EXPECT_EQ(files_in_cache(), 2u);  // radii are scaled after that

  const auto refused = [&](const std::string& lines, const std::vector<std::string>& parts) {
    write("scene.toml", "[assembly]\npacking = \"random\"\nlength = \"8 mm\"\nwidth = \"2 mm\"\ndiscs = 300\n" + lines);
    const SubprocessResult result = ddem({"pack", path("scene.toml"), "-o", path("discs.csv")});
    EXPECT_EQ(result.exit_code, 2) << lines;
    for (const std::string& part : parts) EXPECT_THAT(result.standard_error, HasSubstr(part));
  };
  refused("porosity = 0.9\n", {"scene.toml:6: assembly.porosity = 0.9", "cannot be met", "can be had"});
  refused("grading = \"sieve\"\n", {"assembly.sieve: missing"});
  refused("sieve = \"curve.csv\"\n", {"assembly.sieve", "means nothing unless assembly.grading = \"sieve\""});
  refused("grading = \"sieve\"\nsieve = \"curve.csv\"\nradius_ratio = 2\n", {"assembly.radius_ratio = 2", "leave radius_ratio out"});
  for (const auto& [rows, says] : std::vector<std::pair<std::string, std::string>>{
           {"1,0\n2,50\n", "curve.csv:3: passing = 50: must be from 0 to 1"}, {"1,0.1\n2,1\n", "curve.csv:2: passing = 0.1: the first share must be 0"},
           {"1,0\n2,0.9\n", "curve.csv:3: passing = 0.9: the last share must be 1"}, {"2,0\n1,1\n", "curve.csv:3: radius = 1: not larger"},
           {"1,0\n2,0.6\n3,0.5\n4,1\n", "curve.csv:4: passing = 0.5: less than"}, {"1,0\n", "a single row"}, {"0,0\n1,1\n", "curve.csv:2: radius = 0: must be greater than 0"}}) {
    write("curve.csv", "radius,passing\n" + rows);
    refused("grading = \"sieve\"\nsieve = \"curve.csv\"\n", {says});
  }
  write("curve.csv", "radius,passing\n1,0\n30,1\n");
  refused("grading = \"sieve\"\nsieve = \"curve.csv\"\n", {"at most ten times the smallest"});
}

TEST_F(Pack, TellsContactsAndFabricAndDrawsThem) {
  const Json j = packed("discs = 330\n");
  EXPECT_NEAR(j["held_coordination"].get<double>(), 4.05, 0.15);
  EXPECT_LT(j["fabric_anisotropy"].get<double>(), 0.3);
  EXPECT_THAT(text_, HasSubstr("(isostatic: 4)"));
  const SubprocessResult drawn = ddem({"pack", path("scene.toml"), "-o", path("discs.csv"), "--figure", path("discs.svg")});
  EXPECT_EQ(drawn.exit_code, 0) << drawn.standard_error;
  EXPECT_THAT(read("discs.svg"), HasSubstr("pair correlation g"));
  EXPECT_EQ(ddem({"pack", path("scene.toml"), "-o", path("discs.csv"), "--figure", path("scene.toml")}).exit_code, 2);  // no input is replaced
}

TEST_F(Pack, FewDiscsAreJammedAsAWholeAnyway) {
  write("scene.toml", "[assembly]\npacking = \"random\"\nlength = \"8 mm\"\nwidth = \"2 mm\"\ndiscs = 300\ncell = \"whole\"\n");
  const SubprocessResult result = ddem({"pack", path("scene.toml"), "-o", path("discs.csv")});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.standard_error, HasSubstr("scene.toml:6: assembly.cell = \"whole\": means nothing of up to 20000 discs"));
}

TEST_F(Pack, TrustsNoCacheFileThatIsNotItsOwn) {
  const packings::RandomSpec spec{.length = 4e-3, .width = 3e-3, .discs = 120, .seed = 5};
  const Packing packing = packings::random_jammed(spec);
  const fs::path file = packing_cache_file(in_folder("own"), spec);
  EXPECT_FALSE(read_cached_packing(file, spec));
  write_cached_packing(file, spec, packing);
  const auto again = read_cached_packing(file, spec);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->x, packing.x);
  EXPECT_EQ(again->y, packing.y);
  EXPECT_EQ(again->radius, packing.radius);
  EXPECT_EQ(again->period.y, packing.period.y);

  packings::RandomSpec other = spec;
  other.walls.x = true;
  EXPECT_NE(packing_cache_file(in_folder("own"), other), file);
  EXPECT_FALSE(read_cached_packing(file, other));
  other = spec;
  other.grading.law = packings::Grading::Law::log_normal;
  EXPECT_NE(packing_cache_file(in_folder("own"), other), file);
  EXPECT_FALSE(read_cached_packing(file, other));
  const std::string bytes = read_file(file);
  for (const std::size_t at : {std::size_t{0}, std::size_t{200}, bytes.size() - 1}) {
    std::string flipped = bytes;
    flipped[at] = static_cast<char>(flipped[at] ^ 1);
    write_file(file, flipped);
    EXPECT_FALSE(read_cached_packing(file, spec)) << at;
  }
  write_file(file, bytes.substr(0, 300));
  EXPECT_FALSE(read_cached_packing(file, spec));
}

/// Whoever writes a file can write its digest: the packing itself must be one of jamming (random_test.cc has the forgeries).
TEST_F(Pack, TrustsNoCacheFileThatIsNoJammedPacking) {
  const packings::RandomSpec spec{.length = 4e-3, .width = 3e-3, .discs = 120, .seed = 5};
  const Packing packing = packings::random_jammed(spec);
  const fs::path file = packing_cache_file(in_folder("own"), spec);
  Packing smaller = packing;
  for (double& radius : smaller.radius) radius *= 0.97;
  write_cached_packing(file, spec, smaller);
  ASSERT_TRUE(fs::exists(file));
  EXPECT_FALSE(read_cached_packing(file, spec));

  // Nor one that others may have put there.
  write_cached_packing(file, spec, packing);
  ASSERT_TRUE(read_cached_packing(file, spec));
  fs::permissions(file, fs::perms::others_write, fs::perm_options::add);
  EXPECT_FALSE(read_cached_packing(file, spec));
  fs::permissions(file, fs::perms::others_write, fs::perm_options::remove);
  fs::rename(file, in_folder("aside"));
  fs::create_symlink(in_folder("aside"), file);
  EXPECT_FALSE(read_cached_packing(file, spec));
  write_cached_packing(file, spec, smaller);  // takes the place of the link, and not of what it points to
  EXPECT_FALSE(fs::is_symlink(file));
  fs::rename(in_folder("aside"), file);
  EXPECT_TRUE(read_cached_packing(file, spec));
}

TEST_F(Pack, CacheFilesThatAreNoneAreMadeAnewAndNamed) {
  packed("discs = 330\n");
  const std::string made = read("discs.csv");
  const fs::path file = *fs::directory_iterator(in_folder("cache") / "ddem");
  const auto again = [&] {
    const SubprocessResult run = ddem({"pack", path("scene.toml"), "-o", path("discs.csv")});
    EXPECT_EQ(run.exit_code, 0) << run.standard_error;
    EXPECT_EQ(read("discs.csv"), made);
    EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(file)));
    return run.standard_error;
  };
  fs::remove(file);
  ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
  EXPECT_THAT(again(), HasSubstr(file.filename().string()));
  fs::remove(file);
  fs::create_symlink("/dev/zero", file);
  EXPECT_THAT(again(), HasSubstr("made anew"));
  EXPECT_THAT(again(), Not(HasSubstr("made anew")));
}

/// What was used last stays, and so does what is no packing.
TEST_F(Pack, CacheIsTrimmedByLastUse) {
  const fs::path folder = in_folder("own");
  fs::create_directories(folder);
  const auto now = fs::file_time_type::clock::now();
  for (int k = 0; k < 5; ++k) {
    const fs::path file = folder / ("packing-" + std::to_string(k));
    write_file(file, std::string(1000, 'x'));
    fs::last_write_time(file, now - std::chrono::hours(k == 2 ? 100 : k));
  }
  write_file(folder / "notes", std::string(5000, 'x'));
  fs::last_write_time(folder / "notes", now - std::chrono::hours(1000));
  trim_packing_cache(folder, 5000);
  EXPECT_TRUE(fs::exists(folder / "packing-2"));  // 5000 bytes are within the limit
  trim_packing_cache(folder, 3999);               // two files too many: the oldest ones, 2 and 4
  for (int k = 0; k < 5; ++k) EXPECT_EQ(fs::exists(folder / ("packing-" + std::to_string(k))), k != 2 && k != 4) << k;
  EXPECT_TRUE(fs::exists(folder / "notes"));
  trim_packing_cache(folder, 0);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
  trim_packing_cache(in_folder("nowhere"), 0);  // no folder, no error
}

/// Read is used: the packing of a later run is not the one that leaves.
TEST_F(Pack, ReadingFromTheCacheCountsAsUse) {
  packed("discs = 330\n");
  const fs::path file = *fs::directory_iterator(in_folder("cache") / "ddem");
  const auto old = fs::file_time_type::clock::now() - std::chrono::hours(48);
  fs::last_write_time(file, old);
  packed("discs = 330\n");
  EXPECT_GT(fs::last_write_time(file), old + std::chrono::hours(47));
}

}  // namespace
}  // namespace ddem::harness::test
