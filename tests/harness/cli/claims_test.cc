// Every output of every command against all that must not be written over: refused before anything is done, with nothing
// changed and nothing printed.

#include <algorithm>
#include <sys/stat.h>
#include <unistd.h>

#include <set>

#include "tests/harness/cli/program.h"

namespace ddem::harness::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

/// A continuum scene with a mesh of its own that nobody reads before its outputs are claimed.
std::string mesh_scene() {
  return "[assembly]\nlength = \"10 mm\"\nwidth = \"2 mm\"\n[boundary]\ntop_bottom = \"periodic\"\nright = \"fixed\"\n[drive]\n"
         "wave = \"shear\"\nduration = \"1 us\"\namplitude = \"1 um\"\n[continuum]\nyoung_modulus = \"10 GPa\"\n"
         "poisson_ratio = 0.25\ndensity = 1700\nmesh = \"strip.msh\"\n";
}

class Claims : public Cli {
 protected:
  struct Writer {
    std::vector<std::string> arguments;  ///< up to the output's name
    std::string input;                   ///< a file that it reads
  };

  void SetUp() override {
    write("scene.toml", file_scene());
    write("discs.csv", disc_table(small_lattice()));
    write("continuum.toml", mesh_scene());
    write("strip.msh", "$MeshFormat\n");
    fs::create_directory(in_folder("night"));
    write("night/summary.json", "{}");
  }

  std::vector<Writer> writers() const {
    const std::string scene = path("scene.toml"), continuum = path("continuum.toml");
    const std::vector<std::string> calibrate{"calibrate", "--young",     "30 GPa", "--poisson",       "0.25", "--density", "2400",
                                             "--assembly", scene, "--proof-seeds", "0",    "-o"};
    return {{{"run", scene, "-o"}, "discs.csv"},
            {{"run", scene, "--signals"}, "scene.toml"},
            {{"fem", continuum, "-o"}, "strip.msh"},
            {{"fem", continuum, "--signals"}, "strip.msh"},
            {{"pack", scene, "-o"}, "discs.csv"},
            {calibrate, "scene.toml"},
            {{"baseline", "update", path("night"), "-o"}, "night/summary.json"}};
  }

  void expect_no(const Writer& w, const std::string& output, const std::string& why, int exit_code = 2, bool force = false) const {
    const auto before = contents();
    std::vector<std::string> arguments = w.arguments;
    arguments.push_back(output.starts_with('/') ? output : path(output));
    if (force) arguments.push_back("--force");
    const auto run = ddem(arguments);
    EXPECT_EQ(run.exit_code, exit_code) << testing::PrintToString(arguments) << run.status() << run.standard_error;
    const bool as_json = std::find(arguments.begin(), arguments.end(), "--json") != arguments.end();
    EXPECT_TRUE(as_json ? run.standard_output.starts_with("{\n  \"status\": \"") && run.standard_output.find("\"ok\"") == std::string::npos : run.standard_output.empty());
    EXPECT_THAT(run.standard_error, HasSubstr(why)) << testing::PrintToString(arguments);
    expect_contents(before);
  }
};

TEST_F(Claims, AnInputByAnyName) {
  for (const Writer& w : writers()) {
    for (const char* name : {"soft", "hard"}) fs::remove(in_folder(name));
    fs::create_symlink(w.input, in_folder("soft"));
    fs::create_hard_link(in_folder(w.input), in_folder("hard"));
    for (const std::string& name : {w.input, "./" + w.input, "night/../" + w.input, std::string("soft"), std::string("hard")})
      expect_no(w, name, "would overwrite", 2, name == w.input);
  }
}

TEST_F(Claims, WhatIsNoFileOfTheirs) {
  write("thesis.txt", "precious");
  write("foreign.csv", "time,temperature\n0,1\n");
  write("foreign.h5", "\x89HDF\r\n\x1a\n of another program");
  fs::create_directory(in_folder("folder"));
  fs::create_symlink("nowhere/at/all", in_folder("broken"));
  for (const Writer& w : writers()) {
    for (const char* name : {"thesis.txt", "foreign.csv", "foreign.h5"}) expect_no(w, name, "--force");
    expect_no(w, "folder", "is a folder", 2, true);
    expect_no(w, "folder/", "names no file");
    expect_no(w, "none/new", "does not exist; create it first");
    expect_no(w, "thesis.txt/new", "is not a folder");
    expect_no(w, "broken", "does not exist; create it first");
    expect_no(w, std::string(256, 'n'), "name is longer");
    expect_no(w, "/sys/new", "/sys/new: cannot create a file there", 4);
  }
}

TEST_F(Claims, EachOther) {
  const std::string scene = path("scene.toml");
  fs::create_symlink("y.h5", in_folder("link"));
  for (const char* other : {"y.h5", "./y.h5", "night/../y.h5", "link"}) {
    const Writer w{{"run", scene, "-o", path("y.h5"), "--signals"}, ""};
    expect_no(w, other, "would overwrite");
  }
  // ParaView's file beside y.h5 is an output, too, of a name that cannot be chosen.
  expect_no({{"run", scene, "--snapshots", "2", "-o", path("y.h5"), "--signals"}, ""}, "y.xdmf", "would overwrite");
  expect_no({{"run", scene, "--snapshots", "2", "-o"}, ""}, "y.xdmf", "would overwrite");
  write("y.xdmf", "mine");
  expect_no({{"run", scene, "--snapshots", "2", "-o"}, ""}, "y.h5", "y.xdmf: is there, and is not an XDMF file");
  expect_no({{"run", scene, "--snapshots", "2", "-o"}, ""}, std::string(252, 'n') + ".h5", "name is longer");
}

TEST_F(Claims, OneBadOutputIsEnough) {
  fs::create_directory(in_folder("folder.h5"));
  const std::string scene = path("scene.toml");
  for (const char* json : {"--json", "--force"}) {
    expect_no({{"run", scene, json, "--signals", path("new.csv"), "-o"}, ""}, "folder.h5", "is a folder");
    expect_no({{"run", scene, json, "-o", path("new.h5"), "--signals"}, ""}, "none/a.csv", "does not exist");
  }
  for (const char* device : {"/dev/null", "/dev/stdout"}) expect_no({{"run", scene, "-o"}, ""}, device, "cannot go to a device");
}

TEST_F(Claims, FoldersWithForeignFiles) {
  fs::create_directory(in_folder("mine"));
  for (const char* name : {"bench.json", "bench.html", "design-curves.csv", "design-curves.svg"}) {
    write(std::string("mine/") + name, "precious");
    const bool bench = std::string(name).starts_with("bench");
    const Writer w = bench ? Writer{{"bench", "--only", "peers", "-o"}, ""}
                           : Writer{{"calibrate", "--young", "30 GPa", "--poisson", "0.25", "--density", "2400", "--curves"}, ""};
    expect_no(w, "mine", std::string(name) + ": is there, and is not");
    fs::remove(in_folder(std::string("mine/") + name));
  }
  // The assembly that is calibrated lies where its curves would go.
  write("mine/design-curves.csv", disc_table(small_lattice()));
  write("here.toml", replaced(file_scene(), "discs.csv", "mine/design-curves.csv"));
  expect_no({{"calibrate", "--young", "30 GPa", "--poisson", "0.25", "--density", "2400", "--assembly", path("here.toml"), "--curves"}, ""}, "mine",
            "would overwrite", 2, true);
}

TEST_F(Claims, FoldersThatCannotBe) {
  write("file", "precious");
  write("campaign.toml", "[[case]]\nid = \"a\"\nscene = \"scene.toml\"\n[[case.criterion]]\nmetric = \"wave_speed\"\nlower = 1\nderivation = \"x\"\n");
  for (const char* folder : {"file", "file/deeper"}) {
    expect_no({{"validate", path("campaign.toml"), "-o"}, ""}, folder, "name a folder");
    expect_no({{"bench", "--only", "peers", "-o"}, ""}, folder, "name a folder");
  }
  for (const char* folder : {"/sys", "/sys/deeper"}) {
    expect_no({{"validate", path("campaign.toml"), "-o"}, ""}, folder, "cannot create", 4);
    expect_no({{"bench", "--only", "peers", "-o"}, ""}, folder, "cannot create", 4);
  }
  // Known before the campaign runs, too.
  const auto run = ddem({"validate", path("campaign.toml"), "-o", path("night"), "--history", path("file")});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.standard_error, HasSubstr("file: is a file"));
  EXPECT_FALSE(fs::exists(in_folder("night/plan.json")));
}

TEST_F(Claims, WhatTheyWroteThemselvesTheyReplace) {
  const std::string scene = path("scene.toml"), a = path("a.h5"), b = path("b.csv"), p = path("p.csv");
  write("b.csv", "");  // as mktemp makes it
  for (int time = 0; time < 2; ++time) {
    const auto run = ddem({"run", scene, "--snapshots", "2", "-o", a, "--signals", b});
    EXPECT_EQ(run.exit_code, 0) << run.standard_error;
    EXPECT_EQ(ddem({"pack", scene, "-o", p}).exit_code, 0);
    EXPECT_EQ(run_program("/usr/bin/env", {"PATH=" + path("nowhere"), DDEM_PROGRAM, "bench", "--only", "peers", "-o", path("bench")}).exit_code, 0);
  }
  const std::string signals = read("b.csv");
  expect_no({{"run", scene, "--signals"}, ""}, "p.csv", "is there, and is not signals as CSV");
  expect_no({{"pack", scene, "-o"}, ""}, "a.h5", "is there, and is not a packing as CSV");
  EXPECT_EQ(ddem({"run", scene, "--signals", p, "--force"}).exit_code, 0);
  EXPECT_EQ(read("p.csv"), signals);
}

TEST_F(Claims, CalibratedScenesAreReplacedAndReadersOnesAreNot) {
  std::vector<std::string> arguments{"calibrate", "--bar-velocity", "2000 m/s", "--shear-velocity", "1250 m/s", "--density", "2000", "--assembly",
                                     path("scene.toml"), "--proof-seeds", "0", "--curves", path("night"), "-o", path("found.toml")};
  for (int time = 0; time < 2; ++time) {
    const auto run = ddem(arguments);
    ASSERT_EQ(run.exit_code, 0) << run.standard_error;
  }
  const std::string found = read("found.toml");
  EXPECT_TRUE(found.starts_with("# Written by ddem calibrate.\n[assembly]"));
  // What was found and then changed is calibrated again.
  arguments[8] = path("found.toml");
  arguments.back() = path("again.toml");
  EXPECT_EQ(ddem(arguments).exit_code, 0);
  EXPECT_EQ(read("again.toml").find("# Written", 1), std::string::npos);
  EXPECT_EQ(ddem({"moduli", path("found.toml")}).exit_code, 0);
}

TEST_F(Claims, PermissionsAndLinksStay) {
  const std::string scene = path("scene.toml");
  fs::create_directory(in_folder("target"));
  for (const char* name : {"a.h5", "a.csv", "a.xdmf"}) {
    write(name, "");
    fs::permissions(in_folder(name), static_cast<fs::perms>(0600));
  }
  fs::create_symlink("target/real.csv", in_folder("link.csv"));
  const auto links = [&](const std::string& output) { return ddem({"run", scene, "--snapshots", "1", "-o", path("a.h5"), "--signals", path(output)}); };
  EXPECT_EQ(links("a.csv").exit_code, 0);
  for (const char* name : {"a.h5", "a.csv", "a.xdmf"}) {
    EXPECT_EQ(fs::status(in_folder(name)).permissions(), static_cast<fs::perms>(0600)) << name;
    EXPECT_NE(read(name), "");
  }
  for (int time = 0; time < 2; ++time) {  // first where nothing is, then over it
    EXPECT_EQ(links("link.csv").exit_code, 0);
    EXPECT_TRUE(fs::is_symlink(in_folder("link.csv")));
    EXPECT_EQ(read("target/real.csv"), read("a.csv"));
  }
}

TEST_F(Claims, NamesOfAllLengthsAndKinds) {
  const std::string scene = path("scene.toml");
  for (const std::string& stem : {std::string(245, 'n'), std::string("a b"), std::string("\xc3\xa4'\"$(x)\\"), std::string("-o"), std::string("<&>")}) {
    const auto run = ddem({"run", scene, "--snapshots", "2", "--output=" + path(stem + ".h5"), "--signals=" + path(stem + ".csv")});
    EXPECT_EQ(run.exit_code, 0) << stem << run.standard_error;
    for (const char* ending : {".h5", ".xdmf", ".csv"}) EXPECT_NE(read(stem + ending), "") << stem;
  }
  EXPECT_EQ(ddem({"run", scene, "--signals", path(std::string(255, 'n'))}).exit_code, 0);
  EXPECT_EQ(ddem({"run", scene, "-o", path("two\nlines")}).exit_code, 0);
  EXPECT_EQ(ddem({"run", scene, "--snapshots", "2", "-o", path("two\nlines.h5")}).exit_code, 2);  // XML cannot say it
  EXPECT_EQ(ddem({"run", scene, "--snapshots", "2", "-o", path("\xff.h5")}).exit_code, 2);
}

TEST_F(Claims, ADiscHasOneSignalHoweverOftenItIsAskedFor) {
  const auto probes = [&](const std::string& lines) {
    const std::string scene = small_scene();
    return scene.substr(0, scene.find("[probes]")) + "[probes]\n" + lines;
  };
  const std::size_t some = 0;
  for (const auto& [lines, discs] : {std::pair{"discs = [12, 40]\n[time]\nsteps = 20", std::size_t{2}},
                                     {"points = [[0.003, 0.0005], [0.003, 0.0005], [0.00301, 0.0005]]\n[time]\nsteps = 20", std::size_t{1}},
                                     {"pairs = 30", some}}) {
    write("scene.toml", probes(lines));
    const auto run = ddem({"run", path("scene.toml"), "-o", path("a.h5"), "--signals", path("a.csv")});
    ASSERT_EQ(run.exit_code, 0) << lines << run.standard_error;
    const std::string text = read("a.csv"), header = text.substr(0, text.find('\n'));
    std::vector<std::string> columns(1);
    for (const char c : header) {
      if (c == ',') {
        columns.emplace_back();
      } else {
        columns.back() += c;
      }
    }
    const bool has_repeats = std::set<std::string>(columns.begin(), columns.end()).size() < columns.size();
    EXPECT_FALSE(has_repeats) << header;
    if (discs != some) {
      EXPECT_EQ(columns.size(), 1 + 3 * discs) << header;
    }
  }
}

}  // namespace
}  // namespace ddem::harness::test
