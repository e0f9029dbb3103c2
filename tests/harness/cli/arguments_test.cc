// Arguments of all commands, as their help lists them: what is empty, no number, contradictory or misspelt is refused.

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "tests/harness/cli/program.h"

namespace ddem::harness::test {
namespace {

using testing::HasSubstr;

struct Option {
  std::string name;
  bool is_number;
};

class Arguments : public Cli {
 protected:
  /// What begins there and has no other characters.
  static std::string word_of(const std::string& line, std::size_t at, const char* characters) {
    if (at >= line.size()) return "";
    return line.substr(at, std::min(line.find_first_not_of(characters, at), line.size()) - at);
  }

  /// Names in the list of commands of a help.
  static std::vector<std::string> commands_in(const std::string& help) {
    std::vector<std::string> names;
    const std::size_t list = help.find("\nSubcommands:\n");
    if (list == std::string::npos) return names;
    std::istringstream lines(help.substr(list + 13, help.find("\n\n", list) - list - 13));
    for (std::string line; std::getline(lines, line);) {
      const std::string name = word_of(line, 2, "abcdefghijklmnopqrstuvwxyz-");
      if (!name.empty() && line.starts_with("  ") && line.substr(2 + name.size()).starts_with(' ')) names.push_back(name);
    }
    return names;
  }

  /// Options that take a value.
  static std::vector<Option> options_in(const std::string& help) {
    std::vector<Option> options;
    std::istringstream lines(help);
    for (std::string line; std::getline(lines, line);) {
      std::size_t at = 2;  // "  -o,--output TEXT", "  --jobs UINT:..."
      if (line.size() > 5 && line[2] == '-' && line[3] != '-' && line[4] == ',') at = 5;
      if (!line.starts_with("  ") || line.substr(std::min(at, line.size()), 2) != "--") continue;
      const std::string name = word_of(line, at, "abcdefghijklmnopqrstuvwxyz-");
      for (const char* type : {" TEXT", " INT", " FLOAT", " UINT"}) {
        if (line.substr(at + name.size()).starts_with(type)) options.push_back({name, std::string(type) != " TEXT"});
      }
    }
    return options;
  }

  /// Every command, with what its help says; of commands that have commands, those.
  std::vector<std::pair<std::vector<std::string>, std::string>> all_commands() const {
    std::vector<std::pair<std::vector<std::string>, std::string>> all;
    for (const std::string& name : commands_in(ddem({"--help"}).standard_output)) {
      const std::string help = ddem({name, "--help"}).standard_output;
      const auto inner = commands_in(help);
      if (inner.empty()) all.push_back({{name}, help});
      for (const std::string& word : inner) all.push_back({{name, word}, ddem({name, word, "--help"}).standard_output});
    }
    return all;
  }

  void expect_wrong(const std::vector<std::string>& arguments, const std::string& named) const {
    const auto run = ddem(arguments);
    EXPECT_EQ(run.exit_code, 2) << testing::PrintToString(arguments) << run.standard_error;
    EXPECT_THAT(run.standard_error, HasSubstr(named)) << testing::PrintToString(arguments);
    const bool as_json = std::find(arguments.begin(), arguments.end(), "--json") != arguments.end();
    EXPECT_EQ(run.standard_output.empty(), !as_json) << testing::PrintToString(arguments);
  }
};

TEST_F(Arguments, AreNeverEmptyAndNumbersAreNumbers) {
  std::size_t options = 0;
  for (const auto& [command, help] : all_commands()) {
    for (const char* blank : {"", " \t\n"}) {
      std::vector<std::string> line = command;
      line.push_back(blank);
      if (help.find("\nPositionals:\n") != std::string::npos) expect_wrong(line, "an empty text");
    }
    for (const Option& option : options_in(help)) {
      ++options;
      std::vector<std::string> with = command;
      for (const std::string& word : {option.name, std::string(options % 2 == 0 ? "" : " \t")}) with.push_back(word);
      expect_wrong(with, option.name);
      with = command;
      with.push_back(option.name + "=");
      expect_wrong(with, "--");
      if (!option.is_number) continue;
      for (const char* value : {"x", "0x", "1e9999", "99999999999999999999", "-1", "nan", "1,5"}) {
        with = command;
        for (const std::string& word : {option.name, std::string(value)}) with.push_back(word);
        const auto run = ddem(with);
        EXPECT_EQ(run.exit_code, 2) << testing::PrintToString(with) << run.standard_error;
      }
    }
  }
  EXPECT_GT(options, 30u) << "the help has another form, and this test has lost its list";
  EXPECT_TRUE(contents().empty());
}

TEST_F(Arguments, SlipsAreExplained) {
  write("scene.toml", small_scene());
  const std::string scene = path("scene.toml");
  expect_wrong({"rum", scene}, "rum: unknown command; did you mean run?");
  expect_wrong({"--json", "moduly", scene}, "moduly: unknown command; did you mean moduli?");
  expect_wrong({"xyzzy"}, "xyzzy: unknown command; there are validate, ");
  expect_wrong({"baseline", "updat", "x"}, "updat: unknown command; did you mean update?");
  expect_wrong({"run", scene, "--singals", "s.csv"}, "--singals: unknown option; did you mean --signals?");
  expect_wrong({"run", scene, "--signal=s.csv"}, "--signal: unknown option; did you mean --signals?");
  expect_wrong({"fem", scene, "--qqqqqqqqq"}, "--qqqqqqqqq: unknown option; there are --help, ");
  expect_wrong({"run", scene, "other.toml"}, "other.toml");
  expect_wrong({"\033[2J"}, "\\x1b[2J: unknown command");
  expect_wrong({}, "ddem: a command is missing; there are validate, ");
  expect_wrong({"baseline"}, "ddem: baseline: a command is missing; there are update");
  expect_wrong({"--json"}, "--json: unknown option");
  expect_wrong({"compare", scene, scene}, "scene.toml: a file; give the folder of a run");
}

TEST_F(Arguments, NumbersOfNoPossibleSizeAreToldTheirRange) {
  write("scene.toml", small_scene());
  for (const char* value : {"1e400", "-1e400", "1e-400", "1e300", "-1", "0", "inf", "nan"}) {
    expect_wrong({"calibrate", fmt::format("--young={}", value), "--poisson", "0.25", "--density", "2400"}, "write \"10 GPa\"");
    expect_wrong({"calibrate", fmt::format("--young={}", value), "--poisson", "0.25", "--density", "2400"}, "1e+21");
    expect_wrong({"stability", path("scene.toml"), fmt::format("--wavelength={}", value)}, "--wavelength");
  }
}

TEST_F(Arguments, ThatDoNothingBesideOthersAreRefused) {
  write("scene.toml", small_scene());
  const std::string scene = path("scene.toml");
  for (const char* command : {"run", "fem"}) expect_wrong({command, scene, "--snapshots", "3"}, "--output");
  expect_wrong({"run", scene, "--snapshots", "0", "-o", path("a.h5")}, "0");
  expect_wrong({"run", scene, "-o", path("a.h5"), "-o", path("b.h5")}, "--output");
  for (const char* shard : {"0/0", "3/2", "0/2", "1/0", "-1/2", "1", "1/2/3", "a/b", "1/99999999999", "1/2 "})
    expect_wrong({"validate", "-o", path("report"), "--shard", shard}, "shard");
  expect_wrong({"validate", "-o", path("report"), "--plan", "--history", path("history")}, "--plan");
  expect_wrong({"validate", "-o", path("report"), "--plan", "-j", "2"}, "--plan");
  write("lattice.toml", "[assembly]\npacking = \"hexagonal\"\ncolumns = 4\nrows = 4\nradius = \"0.1 mm\"\nperiodic = \"xy\"\n");
  expect_wrong({"calibrate", "--young", "30e9", "--poisson", "0.25", "--density", "2400", "--assembly", path("lattice.toml"), "--seeds", "4"}, "--seeds");
  expect_wrong({"calibrate", "--young", "30e9", "--poisson", "0.25", "--density", "2400", "--assembly", path("lattice.toml"), "--proof-seeds", "4"}, "--proof-seeds");
  EXPECT_EQ(contents().size(), 2u);
}

/// Of the others the output is required, or has a default.
TEST_F(Arguments, NothingToForce) {
  write("scene.toml", small_scene());
  const std::string scene = path("scene.toml");
  for (const std::vector<std::string>& command : {std::vector<std::string>{"run", scene},
                                                  {"fem", scene},
                                                  {"calibrate", "--young", "30e9", "--poisson", "0.25", "--density", "2400"},
                                                  {"bench", "--only", "peers"},
                                                  {"report", path(".")}}) {
    std::vector<std::string> forced = command;
    forced.push_back("--force");
    expect_wrong(forced, "--force");
  }
}

TEST_F(Arguments, NothingToPrefer) {
  std::vector<std::string> line = {"calibrate", "--young", "30e9", "--poisson", "0.25", "--density", "2400", "--prefer"};
  const auto with = [&line](std::vector<std::string> more) {
    more.insert(more.begin(), line.begin(), line.end());
    return more;
  };
  for (const char* how : {"margin", "stiffest"}) {
    line.back() = "--prefer=" + std::string(how);
    expect_wrong(with({}), "--prefer: there is nothing to choose, rigid discs");
    write("soft.toml", "[assembly]\npacking = \"hexagonal\"\ncolumns = 4\nrows = 4\nradius = \"0.1 mm\"\nperiodic = \"xy\"\n"
                       "[deformation]\nscheme = \"implicit\"\ncorrection = \"full\"\nyoung_modulus = 1e10\npoisson_ratio = 0.3\n");
    const std::vector<std::string> soft = {"--assembly", path("soft.toml"), "--softness", "0.1"};
    std::vector<std::string> held = soft;
    held.insert(held.end(), {"--particle-poisson", "0.3"});
    expect_wrong(with(held), "--prefer: there is nothing to choose, Poisson's ratio settles");
    EXPECT_EQ(ddem(with(soft)).exit_code, 0) << "k_t/k_n and nu_p are free";
  }
}

TEST_F(Arguments, AnEmptyCampaignIsNotTheOneOfThePaper) {
  for (const char* text : {"", "# nothing\n", "\n\n"}) {
    write("campaign.toml", text);
    expect_wrong({"validate", path("campaign.toml"), "-o", path("report")}, "campaign.toml: an empty campaign; write [strip]");
  }
  EXPECT_EQ(contents().size(), 1u);
}

}  // namespace
}  // namespace ddem::harness::test
