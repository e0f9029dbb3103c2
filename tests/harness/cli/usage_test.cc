// Help, versions, wrong arguments, and outputs that cannot be written.

#include "harness/io/json.h"
#include "tests/harness/cli/program.h"

namespace ddem::harness::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const char* const kCommands[] = {"validate",  "run",   "fem",  "moduli", "stability",
                                 "calibrate", "bench", "pack", "report", "compare", "measure"};

TEST_F(Cli, EveryCommandHelps) {
  const auto all = ddem({"--help"});
  EXPECT_EQ(all.exit_code, 0);
  for (const char* command : kCommands) {
    EXPECT_THAT(all.standard_output, HasSubstr(std::string("\n  ") + command + " "));
    const auto help = ddem({command, "--help"});
    EXPECT_EQ(help.exit_code, 0) << command;
    EXPECT_THAT(help.standard_output, HasSubstr("Usage: ")) << command;
  }
}

TEST_F(Cli, VersionNamesCompilerAndLibraries) {
  const auto version = ddem({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_THAT(version.standard_output,
              AllOf(HasSubstr("ddem "), HasSubstr("Eigen "), HasSubstr("HDF5 "), HasSubstr("fmt ")));
}

TEST_F(Cli, WrongArguments) {
  write("scene.toml", small_scene());
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{},
                                                    {"simulate"},
                                                    {"run"},
                                                    {"run", path("scene.toml"), "--fast"},
                                                    {"run", path("scene.toml"), "-o"},
                                                    {"pack", path("scene.toml")},
                                                    {"validate", "-j", "none"},
                                                    {"validate", "-j", "-1"},
                                                    {"bench", "--only", "everything"}}) {
    const auto run = ddem(arguments);
    EXPECT_EQ(run.exit_code, 2) << testing::PrintToString(arguments);
    EXPECT_EQ(run.standard_output, "") << testing::PrintToString(arguments);
    EXPECT_NE(run.standard_error, "") << testing::PrintToString(arguments);
  }
}

// Whoever reads standard output by a program finds a document there, whatever went wrong.
TEST_F(Cli, FailuresAreJsonWhereJsonIsAskedFor) {
  write("scene.toml", small_scene());
  write("wrong.toml", "[assembly]\npacking = \"random\"\nlenth = 1\n");
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"run", path("wrong.toml")},
                                                    {"run", path("missing.toml")},
                                                    {"run", path("scene.toml"), "--fast"},
                                                    {"run", path("scene.toml"), "-o", path("scene.toml")},
                                                    {"moduli", path("wrong.toml")},
                                                    {"stability", path("wrong.toml")},
                                                    {"pack", path("wrong.toml"), "-o", path("p.csv")},
                                                    {"fem", path("wrong.toml")},
                                                    {"calibrate", "--young", "much"},
                                                    {"compare", path("nowhere"), path("none.json")}}) {
    std::vector<std::string> with_json = arguments;
    with_json.push_back("--json");
    const auto run = ddem(with_json);
    EXPECT_EQ(run.exit_code, 2) << testing::PrintToString(arguments);
    const Json j = Json::parse(run.standard_output, nullptr, false);
    ASSERT_TRUE(j.is_object()) << testing::PrintToString(arguments) << run.standard_output;
    EXPECT_EQ(j["status"], "wrong input");
    EXPECT_EQ(j["exit_code"], 2);
    ASSERT_FALSE(j["messages"].empty());
    for (const std::string message : j["messages"]) EXPECT_THAT(run.standard_error, HasSubstr(message)) << testing::PrintToString(arguments);
  }
}

// What it measures is tested in tests/harness/bench; here: one part alone, as JSON and as files, on any machine without
// other programs to compare with.
TEST_F(Cli, BenchWritesWhatItPrints) {
  const auto run = run_program("/usr/bin/env", {"PATH=" + path("nowhere"), DDEM_PROGRAM, "bench", "--only", "peers", "--json", "-o", path("measured")});
  ASSERT_EQ(run.exit_code, 0) << run.standard_error;
  const Json printed = Json::parse(run.standard_output), written = Json::parse(read("measured/bench.json"));
  EXPECT_EQ(printed, written);
  for (const char* key : {"kernels", "work_precision", "peers", "triad_gb_per_s", "provenance"}) EXPECT_TRUE(printed.contains(key)) << key;
  EXPECT_TRUE(printed["kernels"].empty() && printed["work_precision"].empty());
  EXPECT_TRUE(printed["peers"].empty());
  EXPECT_THAT(printed["peers_reason"].get<std::string>(), AllOf(HasSubstr("lmp"), HasSubstr("yade")));
  EXPECT_THAT(read("measured/bench.html"), HasSubstr("Other programs"));
}

// A copy of ddem has no ddem-fem beside it.
TEST_F(Cli, FemWithoutItsProgram) {
  write("scene.toml", small_scene());
  std::filesystem::copy_file(DDEM_PROGRAM, in_folder("ddem"));
  const auto run = run_program(path("ddem"), {"fem", path("scene.toml"), "--json"});
  EXPECT_EQ(run.exit_code, 4) << run.status();
  EXPECT_THAT(run.standard_error, HasSubstr("ddem-fem"));
  EXPECT_EQ(Json::parse(run.standard_output)["status"], "machine failed");
}

}  // namespace
}  // namespace ddem::harness::test
