// Every kind of mistake in a scene: the line, the key and the wording.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <set>

#include "tests/harness/scene/scene_text.h"

namespace ddem::harness::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(SceneErrors, ReadAsTheReferenceSays) {
  EXPECT_EQ(messages(replaced(small_scene(), "stiffness_ratio =", "stifness_ratio =")),
            "scene.toml:8: contact.stiffness_ratio: missing; give a number at least 0, such as 0.25\n"
            "scene.toml:10: contact.stifness_ratio = 0.25: unknown key; did you mean stiffness_ratio?\n");
}

TEST(SceneErrors, CarryTheirParts) {
  const SceneResult result = parse(replaced(small_scene(), "normal_stiffness = 1e10",
                                            "normal_stiffness = 1e10\n  normal_stifness = 1e10  # twice"));
  ASSERT_EQ(result.violations.size(), 1u);
  const Violation& violation = result.violations.front();
  EXPECT_EQ(violation.file, "scene.toml");
  EXPECT_EQ(violation.line, 10);
  EXPECT_EQ(violation.column, 21);
  EXPECT_EQ(violation.key, "contact.normal_stifness");
  EXPECT_EQ(violation.value, "1e10");
  EXPECT_EQ(violation.message, "unknown key");
  EXPECT_EQ(violation.remedy, "did you mean normal_stiffness?");
}

struct Mistake {
  const char* right;  // in small_scene(), or "" to append
  const char* wrong;
  const char* message;  // begin of the only line
};

class OneMistake : public testing::TestWithParam<Mistake> {};

TEST_P(OneMistake, IsTheOnlyViolation) {
  const Mistake& mistake = GetParam();
  const std::string right = mistake.right;
  const std::string text =
      right.empty() ? small_scene() + mistake.wrong : replaced(small_scene(), right, mistake.wrong);
  const SceneResult result = parse(text);
  ASSERT_EQ(result.violations.size(), 1u) << to_string(result.violations);
  EXPECT_FALSE(result);
  EXPECT_THAT(to_string(result.violations.front()), HasSubstr(mistake.message));
}

INSTANTIATE_TEST_SUITE_P(
    UnknownNames, OneMistake,
    testing::Values(
        Mistake{"", "[contac]\nx = 1\n", "scene.toml:14: [contac]: unknown table; did you mean [contact]?"},
        Mistake{"", "[zzzzzz]\nx = 1\n", "unknown table; known tables: assembly, material"},
        Mistake{"[assembly]", "seed = 2\n[assembly]",
                "scene.toml:1: seed = 2: unknown key; it belongs into [assembly]"},
        Mistake{"[assembly]", "run = 5\n[assembly]", "scene.toml:1: run = 5: a value where a table belongs"},
        Mistake{"wave =", "density = 3\nwave =", "unknown key; it belongs into [material] or [continuum]"},
        Mistake{"wave =", "qqqqqq = 3\nwave =",
                "scene.toml:12: initial.qqqqqq = 3: unknown key; known keys here: wave, shape"},
        Mistake{"[assembly]", "\"contact.kinematics\" = \"linear\"\n[assembly]",
                "contact.kinematics = \"linear\": unknown key"},
        Mistake{"", "[title]\n", "scene.toml:14: title: a table where a value belongs"},
        Mistake{"", "[[run]]\nthreads = 1\n", "scene.toml:14: run"},
        Mistake{"", "[run.threads]\na = 1\n",
                "wrong type: this is a table; write a whole number from 1 to 1024"}));

INSTANTIATE_TEST_SUITE_P(
    WrongValues, OneMistake,
    testing::Values(Mistake{"\"random\"", "\"rnadom\"",
                            "scene.toml:2: assembly.packing = \"rnadom\": not one of the choices; write "
                            "\"random\" or \"hexagonal\" "
                            "or \"file\"; did you mean \"random\"?"},
                    Mistake{"\"random\"", "3", "wrong type: this is a whole number"},
                    Mistake{"0.0165", "\"16.5 kg\"",
                            "scene.toml:3: assembly.length = \"16.5 kg\": \"kg\" is not a known unit of "
                            "length; write a length "
                            "greater than 0, such as \"16.5 mm\", \"1 um\" or 0.0165 (metres)"},
                    Mistake{"0.0165", "\"16.5\"", "a number in quotes needs a unit"},
                    Mistake{"0.0165", "-0.0165", "must be greater than 0"},
                    Mistake{"0.0165", "0", "must be greater than 0"},
                    Mistake{"0.0165", "nan", "scene.toml:3: assembly.length = nan: not a finite number"},
                    Mistake{"0.0165", "+inf", "not a finite number"},
                    Mistake{"0.0165", "1979-05-27", "wrong type: this is a date or time"},
                    Mistake{"0.0165", "true", "wrong type: this is true or false"},
                    Mistake{"0.0165", "[1]", "wrong type: this is a list"},
                    Mistake{"682", "682.5", "wrong type: this is a number; write a whole number from 1 to"},
                    Mistake{"682", "0", "scene.toml:5: assembly.discs = 0: must be from 1 to 100000000"},
                    Mistake{"682", "-3", "must be from 1 to"},
                    Mistake{"682", "682\nseed = -1", "assembly.seed = -1: must be at least 0"},
                    Mistake{"682", "682\nradius_ratio = 0.9", "must be from 1 to 10"},
                    Mistake{"682", "682\nbond_gap = -0.1", "must be from 0 to 2"},
                    Mistake{"682", "682\ncoordination = 0", "must be greater than 0"},
                    Mistake{"682", "682\nedge_band = 0", "must be greater than 0"},
                    Mistake{"682", "682\nthickness = \"0 mm\"", "must be greater than 0"},
                    Mistake{"682", "682\nperiodic = \"x\"", "write \"\" or \"y\" or \"xy\""},
                    Mistake{"2000.0", "\"2 g\"", "\"g\" is not a known unit of density"},
                    Mistake{"= 0.25", "= -0.25", "contact.stiffness_ratio = -0.25: must be at least 0"},
                    Mistake{"= 0.25", "= \"0.25\"", "wrong type: this is text"},
                    Mistake{"1e-6", "0.0", "must be different from 0"},
                    Mistake{"", "[time]\nstep = 0\n", "must be greater than 0"},
                    Mistake{"", "[time]\nsteps = 0\n", "time.steps = 0: must be from 1"},
                    Mistake{"", "[time]\nsteps = 2000000001\n", "time.steps = 2000000001: must be from 1 to 2000000000;"},
                    Mistake{"", "[time]\nsample_every = 0\n", "must be from 1"},
                    Mistake{"", "[time]\nallow_above_critical = 1\n", "write true or false"},
                    Mistake{"", "[probes]\npairs = 0\n", "must be from 1 to 1000"},
                    Mistake{"", "[probes]\ndiscs = []\n", "an empty list"},
                    Mistake{"", "[probes]\ndiscs = [3, 4, 3]\n", "3 is there twice"},
                    Mistake{"", "[probes]\ndiscs = [3, -4]\n", "member 2: must be from 0"},
                    Mistake{"", "[probes]\ndiscs = 3\n", "wrong type"},
                    Mistake{"", "[probes]\npoints = [[0.1]]\n", "member 1 is not [x, y]"},
                    Mistake{"", "[probes]\npoints = [0.1, 0.2]\n", "member 1 is not [x, y]"},
                    Mistake{"", "[probes]\npoints = [[0.001, \"1 s\"]]\n",
                            "member 1: \"s\" is a unit of time"},
                    Mistake{"", "[probes]\npoints = [[[1]]]\n", "member 1 is not [x, y]"},
                    Mistake{"", "[continuum]\nelements = [66]\n", "1 members instead of 2"},
                    Mistake{"", "[continuum]\nelements = [66, 0]\n", "member 2: must be from 1"},
                    Mistake{"", "[continuum]\ndegree = 9\n", "must be from 1 to 8"},
                    Mistake{"", "[run]\nthreads = 0\n", "must be from 1 to 1024"}));

INSTANTIATE_TEST_SUITE_P(
    MissingKeys, OneMistake,
    testing::Values(
        Mistake{"packing = \"random\"\n", "", "scene.toml:1: assembly.packing: missing; give \"random\" or"},
        Mistake{"length = 0.0165\n", "", "scene.toml:1: assembly.length: missing"},
        Mistake{"discs = 682\n", "", "assembly.discs: missing"},
        Mistake{"[material]\ndensity = 2000.0\n", "",
                "scene.toml: material.density: missing; give a density"},
        Mistake{"normal_stiffness = 1e10\n", "", "scene.toml:8: contact.normal_stiffness: missing"},
        Mistake{"stiffness_ratio = 0.25\n", "", "contact.stiffness_ratio: missing"},
        Mistake{"amplitude = 1e-6\n", "", "scene.toml:11: initial.amplitude: missing"},
        Mistake{"wave = \"longitudinal\"\n", "", "initial.wave: missing"},
        Mistake{
            "[initial]\nwave = \"longitudinal\"\namplitude = 1e-6\n", "",
            "scene.toml: [initial]: missing: nothing would move; give a table [initial] or a table [drive]"},
        Mistake{"amplitude = 1e-6", "amplitude = 1e-6\nshape = \"cosine\"", "initial.width: missing"},
        Mistake{"[initial]", "[drive]", "scene.toml:11: drive.duration: missing"},
        Mistake{"", "[deformation]\nyoung_modulus = 1e9\n",
                "scene.toml:14: deformation.poisson_ratio: missing"},
        Mistake{"", "[material.x]\n", "unknown key"}));

INSTANTIATE_TEST_SUITE_P(
    Contradictions, OneMistake,
    testing::Values(
        Mistake{
            "682", "682\nbond_gap = 0.3\ncoordination = 5",
            "scene.toml:7: assembly.coordination = 5: contradicts assembly.bond_gap; give one of the two"},
        Mistake{"682", "682\ncolumns = 3",
                "means nothing unless assembly.packing = \"hexagonal\"; leave it out"},
        Mistake{"682", "682\nclose_packed_along = \"y\"",
                "means nothing unless assembly.packing = \"hexagonal\""},
        Mistake{"", "center = 0.001\n", "means nothing unless initial.shape = \"gaussian\""},
        Mistake{"", "[drive]\nwave = \"shear\"\nduration = 1\namplitude = 1\n",
                "scene.toml:14: [drive]: contradicts [initial]; give one of the two"},
        Mistake{"", "[time]\nstep = 1\nstep_fraction = 0.2\n",
                "time.step_fraction = 0.2: contradicts time.step"},
        Mistake{"", "[time]\nend = 1\nsteps = 2\n", "time.steps = 2: contradicts time.end"},
        Mistake{"", "[time]\nstep_fraction = 1.01\n", "a step above the critical one is unstable"},
        Mistake{"", "[probes]\npairs = 2\ndiscs = [1]\n", "probes.discs = [1]: contradicts probes.pairs"},
        Mistake{"", "[probes]\ndiscs = [1]\npoints = [[0, 0]]\n", "contradicts probes.discs"},
        Mistake{"", "[probes]\ndiscs = [1]\nsection = true\n", "sections are averaged for pairs only"},
        Mistake{"", "[probes]\ndiscs = [1, 682]\n", "there is no disc 682; discs are 0 to 681"},
        Mistake{"", "[probes]\npoints = [[0, 0], [0.017, 0]]\n",
                "the point [0.017, 0] lies outside the strip"},
        Mistake{"", "[boundary]\nleft = \"fixed_x\"\n", "the left edge is held, but [initial] displaces it"},
        Mistake{"682", "682\nperiodic = \"xy\"", "no left edge to displace"},
        Mistake{"", "[deformation]\nyoung_modulus = 1e9\npoisson_ratio = 0.5\nplane = \"strain\"\n",
                "scene.toml:16: deformation.poisson_ratio = 0.5: impossible in plane strain"},
        Mistake{"", "[continuum]\nyoung_modulus = 1e9\npoisson_ratio = 0.5\nplane = \"strain\"\n",
                "scene.toml:16: continuum.poisson_ratio = 0.5: impossible in plane strain"},
        Mistake{"", "[continuum]\nyoung_modulus = 1e9\nplane = \"strain\"\n", "continuum.poisson_ratio: missing"},
        Mistake{"", "[deformation]\nyoung_modulus = 1e9\npoisson_ratio = 1\n",
                "must be greater than -1 and less than 1"}));

// Keys that would be taken without a word, and do nothing.
INSTANTIATE_TEST_SUITE_P(
    WithoutEffect, OneMistake,
    testing::Values(
        Mistake{"", "width = 0.001\n", "initial.width = 0.001: means nothing unless initial.shape = \"cosine\" or \"gaussian\""},
        Mistake{"", "shape = \"cosine\"\nwidth = 0.001\ncenter = 0.001\n", "initial.center = 0.001: means nothing unless initial.shape = \"gaussian\""},
        Mistake{"", "[deformation]\nsolver = \"conjugate_gradients\"\nyoung_modulus = 1e11\npoisson_ratio = 0.3\n",
                "deformation.solver = \"conjugate_gradients\": means nothing unless deformation.scheme = \"implicit\""},
        Mistake{"", "[deformation]\ntolerance = 1e-3\nyoung_modulus = 1e11\npoisson_ratio = 0.3\n", "deformation.tolerance = 1e-3: means nothing"},
        Mistake{"", "[deformation]\nscheme = \"implicit\"\nevaluations = 3\nyoung_modulus = 1e11\npoisson_ratio = 0.3\n", "deformation.evaluations = 3: means nothing"},
        Mistake{"", "[deformation]\nscheme = \"implicit\"\nrelaxation = 0.5\nyoung_modulus = 1e11\npoisson_ratio = 0.3\n", "deformation.relaxation = 0.5: means nothing"},
        Mistake{"\"random\"", "\"hexagonal\"\nseed = 1", "assembly.seed = 1: means nothing unless assembly.packing = \"random\""},
        Mistake{"\"random\"", "\"hexagonal\"\nwalls = \"periodic\"", "assembly.walls = \"periodic\": means nothing"},
        Mistake{"", "[probes]\npoints = [[0, 0]]\nsection = false\n", "probes.section = false: sections are averaged for pairs only"},
        Mistake{"[contact]", "[deformation]\nscheme = \"implicit\"\nyoung_modulus = 1e11\npoisson_ratio = 0.3\n[contact]\nkinematics = \"nonlinear\"",
                "contact.kinematics = \"nonlinear\": implicit strains need linear kinematics"},
        Mistake{"", "[deformation]\nyoung_modulus = 1\npoisson_ratio = 0.3\n", "the contacts are more than 1e+08 times as stiff as such discs; give at least 100 Pa"}));

TEST(SceneErrors, ACellHasNoEnds) {
  const std::string cell =
      "[assembly]\npacking = \"hexagonal\"\nperiodic = \"xy\"\nedge_band = 1.2\n[material]\ndensity = 2000\n"
      "[contact]\nnormal_stiffness = 1e10\nstiffness_ratio = 0.2\n[boundary]\nleft = \"fixed\"\nright = \"fixed_x\"\n";
  EXPECT_EQ(messages(cell, Purpose::statics),
            "scene.toml:4: assembly.edge_band = 1.2: a cell that is periodic in x and y has no ends; leave it out, or use periodic = \"y\"\n"
            "scene.toml:11: boundary.left = \"fixed\": a cell that is periodic in x and y has no ends; leave it out, or use periodic = \"y\"\n"
            "scene.toml:12: boundary.right = \"fixed_x\": a cell that is periodic in x and y has no ends; leave it out, or use periodic = \"y\"\n");
}

INSTANTIATE_TEST_SUITE_P(
    NotExactInTime, OneMistake,
    testing::Values(
        Mistake{"", "[deformation]\nyoung_modulus = 1e9\npoisson_ratio = 0.3\n[time]\nintegrator = \"exact\"\n",
                "of lagged strains the time step is a part; use integrator = \"verlet\", or scheme = \"implicit\""},
        Mistake{"", "[deformation]\nscheme = \"implicit\"\nyoung_modulus = 1e9\npoisson_ratio = 0.3\n[time]\nintegrator = \"exact\"\n",
                "the normal correction with shear stiffness has no energy"},
        Mistake{"",
                "[deformation]\nscheme = \"implicit\"\ncorrection = \"full\"\nsolver = \"conjugate_gradients\"\nyoung_modulus = 1e9\n"
                "poisson_ratio = 0.3\n[time]\nintegrator = \"exact\"\n",
                "or solver = \"polynomial\""},
        Mistake{"[contact]", "[time]\nintegrator = \"exact\"\n[contact]\nkinematics = \"nonlinear\"\n", "needs linear kinematics"}));

// No number that a product could overflow or vanish with, whatever the key; said with line, key, value and what may be.
TEST(SceneErrors, NumbersOfNoMagnitude) {
  for (const KeySpec& spec : scene_keys()) {
    if (spec.type != ValueType::number && spec.type != ValueType::points) continue;
    for (const char* value : {"1e-300", "1e300", "-1e300", "-1e-300", "5e-324", "1.7976931348623157e308", "1e-40", "1e40"}) {
      const std::string written = spec.type == ValueType::points ? fmt::format("[[{}, 0]]", value) : std::string(value);
      const SceneResult result = parse(fmt::format("[{}]\n{} = {}\n", spec.table, spec.key, written));
      const std::string dotted = dotted_name(spec.table, spec.key);
      const bool accused = std::any_of(result.violations.begin(), result.violations.end(), [&](const Violation& v) {
        const bool size = v.message.find("too small: a ") != std::string::npos || v.message.find("too large: a ") != std::string::npos;
        return v.key == dotted && v.line == 2 && (size || v.message.starts_with("must be ")) && !v.remedy.empty();
      });
      EXPECT_TRUE(accused) << dotted << " = " << value << "\n" << to_string(result.violations);
    }
  }
  EXPECT_THAT(messages(replaced(small_scene(), "= 1e10", "= 1e-300")),
              StartsWith("scene.toml:9: contact.normal_stiffness = 1e-300: too small: a stiffness other than 0 is at least 1e-09 N/m in size"));
}

TEST(SceneErrors, PlaneStressTakesWhatPlaneStrainCannot) {
  EXPECT_TRUE(parse(small_scene() + "[deformation]\nyoung_modulus = 1e9\npoisson_ratio = 0.5\n"));
  EXPECT_TRUE(parse(small_scene() + "[time]\nstep_fraction = 1.01\nallow_above_critical = true\n"));
  EXPECT_TRUE(parse(small_scene() + "[contact.x]\n").violations.size() == 1u);
}

TEST(SceneErrors, WallsNeedAnEdge) {
  const std::string flat = "[assembly]\npacking = \"random\"\nlength = 1\nwidth = 1\ndiscs = 9\nwalls = \"flat\"\n";
  EXPECT_TRUE(parse(flat, Purpose::packing));
  EXPECT_TRUE(parse(flat + "periodic = \"y\"\n", Purpose::packing));
  EXPECT_EQ(messages(flat + "periodic = \"xy\"\n", Purpose::packing),
            "scene.toml:6: assembly.walls = \"flat\": a cell that is periodic in x and y has no place for walls; leave walls "
            "out, or use periodic = \"y\" for walls at the two ends\n");
}

TEST(SceneErrors, HexagonalByTwoWaysAtOnce) {
  const std::string text = "[assembly]\npacking = \"hexagonal\"\ncolumns = 3\nrows = 3\ndiscs = 9\n";
  EXPECT_EQ(
      messages(text, Purpose::packing),
      "scene.toml:1: assembly.radius: missing; give a length greater than 0, such as \"16.5 mm\", \"1 um\" "
      "or "
      "0.0165 (metres)\n"
      "scene.toml:5: assembly.discs = 9: contradicts columns, rows and radius; give either length, width and "
      "discs, or columns, rows and radius\n");
  const std::string many =
      "[assembly]\npacking = \"hexagonal\"\ncolumns = 100000\nrows = 100000\nradius = 1\n";
  EXPECT_THAT(messages(many, Purpose::packing),
              HasSubstr("scene.toml:3: assembly.columns = 100000: more than"));
}

TEST(SceneErrors, Files) {
  const std::string start = "[assembly]\npacking = \"file\"\n";
  EXPECT_THAT(messages(start, Purpose::packing), StartsWith("scene.toml:1: assembly.file: missing"));
  EXPECT_THAT(messages(start + "file = \"none.csv\"\n", Purpose::packing),
              HasSubstr("scene.toml:3: assembly.file = \"none.csv\": there is no file " +
                        temporary_folder().string()));
  EXPECT_THAT(messages(start + "file = \".\"\n", Purpose::packing), HasSubstr("is a folder"));
  EXPECT_THAT(messages(start + "file = \"/dev/zero\"\n", Purpose::packing), HasSubstr("scene.toml:3: assembly.file = \"/dev/zero\": /dev/zero is a device"));
  EXPECT_THAT(messages(start + "file = \"\"\n", Purpose::packing), HasSubstr("not the name of a file"));
  EXPECT_THAT(messages(start + "file = \"a\\u0000b\"\n", Purpose::packing),
              HasSubstr("not the name of a file"));
  EXPECT_THAT(messages(start + "file = \"" + std::string(5000, 'a') + "\"\n", Purpose::packing),
              HasSubstr("File name too long"));
  write_file("some.csv", "");
  EXPECT_THAT(messages(start + "file = \"some.csv\"\nperiodic = \"y\"\n", Purpose::packing),
              StartsWith("scene.toml:1: assembly.width: missing"));
  EXPECT_THAT(
      messages(start + "file = \"some.csv\"\nbonds = \"some.csv\"\nbond_gap = 0.3\n", Purpose::packing),
      StartsWith("scene.toml:5: assembly.bond_gap = 0.3: contradicts assembly.bonds"));
}

/// A file that a command does not read need not be there; what can be no file's name is wrong for all.
TEST(SceneErrors, FilesAreLookedForByThosePurposesThatReadThem) {
  const std::string scene = small_scene().substr(0, small_scene().find("wave = "));
  const std::string probes = "[probes]\ndiscs = [1]\n";
  constexpr Purpose kAll[] = {Purpose::packing, Purpose::statics, Purpose::simulation, Purpose::continuum};
  struct Case {
    std::string key, table, text;
    std::set<Purpose> readers;
  };
  const std::string complete = "[continuum]\nyoung_modulus = 1\npoisson_ratio = 0.2\ndensity = 1\n";
  const std::string file = "[assembly]\npacking = \"file\"\n", material = small_scene().substr(small_scene().find("[material]"));
  const std::set<Purpose> all(std::begin(kAll), std::end(kAll));
  write_file("some.csv", "");
  for (const Case& c : {Case{"displacement", "initial", scene + "displacement = {}\n" + probes, {Purpose::simulation}},
                        Case{"velocity", "initial", scene + "velocity = {}\n" + probes, {Purpose::simulation}},
                        Case{"mesh", "continuum", small_scene() + complete + "mesh = {}\n", {Purpose::continuum}},
                        Case{"file", "assembly", file + "file = {}\n" + material, all},
                        Case{"bonds", "assembly", file + "file = \"some.csv\"\nbonds = {}\n" + material, all}}) {
    const auto with = [&](const std::string& name) {
      std::string text = c.text;
      return text.replace(text.find("{}"), 2, name);
    };
    for (const Purpose purpose : kAll) {
      SCOPED_TRACE(fmt::format("{} for {}", c.key, static_cast<int>(purpose)));
      EXPECT_EQ(messages(with("\"none.csv\""), purpose).find(c.table + "." + c.key + " = \"none.csv\": there is no file") != std::string::npos, c.readers.contains(purpose))
          << messages(with("\"none.csv\""), purpose);
      if (purpose == Purpose::packing) {
        EXPECT_EQ(parse(with("\"none.csv\""), purpose).violations.empty(), !c.readers.contains(purpose));
      }
      EXPECT_THAT(messages(with("\"\""), purpose), HasSubstr("not the name of a file"));
      EXPECT_THAT(messages(with("3"), purpose), HasSubstr("wrong type"));
    }
  }
}

TEST(SceneErrors, AStateContradictsAPulse) {
  write_file("u0.csv", "");
  EXPECT_EQ(
      messages(small_scene() + "displacement = \"u0.csv\"\n"),
      "scene.toml:12: initial.wave = \"longitudinal\": contradicts initial.displacement; give one of the "
      "two\n"
      "scene.toml:13: initial.amplitude = 1e-6: contradicts initial.displacement; give one of the two\n");
}

TEST(SceneErrors, AreAllListedAtOnceInTheOrderOfTheFile) {
  const std::string text = R"(titel = "x"
[assembly]
packing = "hexagnal"
length = "16.5 kg"
[contact]
normal_stifness = 1e10
stiffness_ratio = -1
[time]
steps = 0
end = nan
[probes]
points = [["1 mm", "2 GPa"]]
[unknown]
[run]
threads = "two"
)";
  const SceneResult result = parse(text);
  std::vector<std::pair<int, std::string>> found;
  for (const Violation& violation : result.violations) found.emplace_back(violation.line, violation.key);
  const std::vector<std::pair<int, std::string>> expected = {{0, "material.density"},
                                                             {0, "[initial]"},
                                                             {1, "titel"},
                                                             {3, "assembly.packing"},
                                                             {4, "assembly.length"},
                                                             {5, "contact.normal_stiffness"},
                                                             {6, "contact.normal_stifness"},
                                                             {7, "contact.stiffness_ratio"},
                                                             {9, "time.steps"},
                                                             {9, "time.steps"},
                                                             {10, "time.end"},
                                                             {12, "probes.points"},
                                                             {13, "[unknown]"},
                                                             {15, "run.threads"}};
  EXPECT_EQ(found, expected) << to_string(result.violations);
}

}  // namespace
}  // namespace ddem::harness::test
