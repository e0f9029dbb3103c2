#include "tests/harness/run/key_values.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>

#include "harness/io/temporary_folder.h"

namespace ddem::harness::test {
namespace {

constexpr double kRadius = 1e-4;
constexpr int kColumns = 8, kRows = 4;

SceneKeys with(SceneKeys keys, const SceneKeys& others) {
  for (const auto& [key, value] : others) keys[key] = value;
  return keys;
}

const SceneKeys lattice = {{"assembly.packing", "\"hexagonal\""}, {"assembly.columns", "8"}, {"assembly.rows", "4"}, {"assembly.radius", "1e-4"}};
const SceneKeys rectangle = {{"assembly.packing", "\"hexagonal\""}, {"assembly.length", "1.6e-3"}, {"assembly.width", "7e-4"}, {"assembly.discs", "32"}};
const SceneKeys random_discs = {{"assembly.packing", "\"random\""}, {"assembly.length", "2e-3"}, {"assembly.width", "8e-4"}, {"assembly.discs", "40"}};
const SceneKeys listed = {{"assembly.packing", "\"file\""}, {"assembly.file", "\"discs.csv\""}, {"assembly.bonds", "\"bonds.csv\""}};
const SceneKeys discs = {{"material.density", "2000"}, {"contact.normal_stiffness", "1e10"}, {"contact.stiffness_ratio", "0.25"}};
const SceneKeys end = {{"time.step", "1e-9"}, {"time.end", "4e-8"}, {"probes.discs", "[9, 12]"}};
const SceneKeys pulse = {{"initial.wave", "\"longitudinal\""}, {"initial.shape", "\"gaussian\""}, {"initial.width", "1e-4"}, {"initial.amplitude", "9e-5"}};
const SceneKeys cosine = {{"initial.shape", "\"cosine\""}};
const SceneKeys drive = {{"drive.wave", "\"shear\""}, {"drive.duration", "2e-8"}, {"drive.amplitude", "1e-6"}};
const SceneKeys soft = {{"deformation.young_modulus", "4e10"}, {"deformation.poisson_ratio", "0.3"}, {"deformation.correction", "\"full\""}};
const SceneKeys implicit = {{"deformation.scheme", "\"implicit\""}};

std::vector<BaseScene> make_scenes() {
  const SceneKeys moving = with(discs, end);
  return {
      {"pulse on a lattice", with(with(lattice, moving), pulse)},
      {"cosine on a lattice", with(with(with(lattice, moving), pulse), cosine)},
      {"drive of a random packing", with(with(with(random_discs, moving), drive), {{"boundary.top_bottom", "\"periodic\""}})},
      {"drive of a sieved packing", with(with(with(random_discs, moving), drive), {{"assembly.grading", "\"sieve\""}, {"assembly.sieve", "\"sieve.csv\""}})},
      {"states of listed discs", with(with(listed, moving), {{"initial.displacement", "\"state.csv\""}, {"boundary.right", "\"free\""}})},
      {"lagged strains", with(with(with(rectangle, moving), drive), soft)},
      {"implicit strains", with(with(with(with(lattice, moving), pulse), soft), implicit)},
      {"exact", with(with(with(with(with(lattice, moving), drive), soft), implicit), {{"time.integrator", "\"exact\""}})},
      {"a cell", with(with(lattice, discs), {{"assembly.periodic", "\"xy\""}})},
      {"pairs of probes", with(with(with(lattice, discs), drive), {{"time.step", "1e-9"}, {"time.end", "4e-8"}, {"probes.pairs", "2"}})},
      {"the continuum alone",
       with(drive, {{"assembly.length", "2e-3"}, {"assembly.width", "8e-4"}, {"continuum.young_modulus", "1e10"}, {"continuum.poisson_ratio", "0.25"},
                    {"continuum.density", "1700"}, {"time.end", "1e-6"}, {"probes.points", "[[1e-3, 2e-4]]"}})},
  };
}

std::string lattice_file(double stretch) {
  std::string text = "x,y,radius\n";
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      text += fmt::format("{},{},{}\n", stretch * kRadius * (2 * column + row % 2), stretch * kRadius * std::sqrt(3.0) * row, kRadius);
    }
  }
  return text;
}

/// Of a disc with the next in its row and the next in the next row; every row is joined.
std::string bonds_file(int rows_joined_every) {
  std::string text = "i,j\n";
  for (int disc = 0; disc < kRows * kColumns; ++disc) {
    const int column = disc % kColumns, row = disc / kColumns;
    if (column + 1 < kColumns) text += fmt::format("{},{}\n", disc, disc + 1);
    if (row + 1 < kRows && column % rows_joined_every == 0) text += fmt::format("{},{}\n", disc, disc + kColumns);
  }
  return text;
}

std::string state_file(double size) {
  std::string text = "ux,uy,theta\n";
  for (int disc = 0; disc < kRows * kColumns; ++disc) text += fmt::format("{},{},{}\n", size * std::sin(disc), size * std::cos(disc), 0.0);
  return text;
}

std::vector<std::string> numbers_of(const KeySpec& spec) {
  if (spec.type == ValueType::integer) return {"3", "2"};
  switch (spec.dimension) {
    case Dimension::length: return {"3e-4", "2e-4"};
    case Dimension::time: return {"3e-9", "2e-9"};
    case Dimension::stress: return {"3e10", "5e10"};
    case Dimension::stiffness: return {"2e10", "3e10"};
    default: return {"0.1", "0.05"};
  }
}

/// Where two values of that size make no difference, or are none.
std::vector<std::string> special_values_of(const std::string& key) {
  static const std::map<std::string, std::vector<std::string>> values = {
      {"assembly.length", {"1.7e-3", "2e-3"}},
      {"assembly.width", {"8e-4", "9e-4"}},
      {"assembly.discs", {"32", "40"}},
      {"assembly.columns", {"8", "9"}},
      {"assembly.rows", {"4", "6"}},
      {"assembly.radius_ratio", {"1.5", "2"}},
      {"assembly.sieve", {"\"sieve.csv\"", "\"other_sieve.csv\""}},
      {"assembly.porosity", {"0.2", "0.25"}},
      {"assembly.bond_gap", {"0.3", "1.6"}},
      {"assembly.coordination", {"4", "5.5"}},
      {"assembly.edge_band", {"1.2", "3"}},
      {"assembly.file", {"\"discs.csv\"", "\"other_discs.csv\""}},
      {"assembly.bonds", {"\"bonds.csv\"", "\"other_bonds.csv\""}},
      {"material.density", {"2000", "3000"}},
      {"deformation.tolerance", {"1e-4", "1e-8"}},
      {"initial.amplitude", {"9e-5", "3e-5"}},
      {"initial.displacement", {"\"state.csv\"", "\"other_state.csv\""}},
      {"initial.velocity", {"\"state.csv\"", "\"other_state.csv\""}},
      {"drive.duration", {"2e-8", "3e-8"}},
      {"drive.amplitude", {"1e-6", "2e-6"}},
      {"continuum.density", {"1500", "2000"}},
      {"continuum.elements", {"[4, 2]", "[6, 2]"}},
      {"continuum.mesh", {"\"mesh.msh\"", "\"other_mesh.msh\""}},
      {"time.step", {"1e-9", "2e-9"}},
      {"time.end", {"3e-8", "4e-8"}},
      {"time.steps", {"30", "40"}},
      {"probes.discs", {"[9, 12]", "[10, 11]"}},
      {"probes.points", {"[[4e-4, 2e-4]]", "[[8e-4, 3e-4]]"}},
  };
  const auto found = values.find(key);
  return found == values.end() ? std::vector<std::string>{} : found->second;
}

}  // namespace

std::string toml_of(const SceneKeys& keys) {
  std::string top, text, table;
  for (const auto& [dotted, value] : keys) {  // a map: table by table
    const std::size_t dot = dotted.find('.');
    if (dot == std::string::npos) {
      top += fmt::format("{} = {}\n", dotted, value);
      continue;
    }
    if (dotted.substr(0, dot) != table) text += fmt::format("[{}]\n", table = dotted.substr(0, dot));
    text += fmt::format("{} = {}\n", dotted.substr(dot + 1), value);
  }
  return top + text;
}

std::vector<std::string> values_of(const KeySpec& spec) {
  if (auto special = special_values_of(dotted_name(spec.table, spec.key)); !special.empty()) return special;
  std::vector<std::string> values;
  switch (spec.type) {
    case ValueType::choice:
      for (const std::string_view name : split_names(spec.choices)) values.push_back(fmt::format("\"{}\"", name));
      return values;
    case ValueType::boolean: return {"true", "false"};
    case ValueType::text: return {"\"a\"", "\"b\""};
    default: return numbers_of(spec);
  }
}

const std::vector<BaseScene>& base_scenes() {
  static const std::vector<BaseScene> scenes = make_scenes();
  return scenes;
}

std::string folder_of_files() {
  static const TemporaryFolder folder("ddem-keys");
  static const bool written = [] {
    const auto write = [](const char* name, const std::string& text) { std::ofstream(folder.path() / name) << text; };
    write("discs.csv", lattice_file(1.0));
    write("other_discs.csv", lattice_file(1.01));
    write("sieve.csv", "radius,passing\n1e-4,0\n2e-4,1\n");
    write("other_sieve.csv", "radius,passing\n1e-4,0\n1.5e-4,1\n");
    write("bonds.csv", bonds_file(1));
    write("other_bonds.csv", bonds_file(2));
    write("state.csv", state_file(1e-6));
    write("other_state.csv", state_file(2e-6));
    write("mesh.msh", "a mesh");
    write("other_mesh.msh", "another");
    return true;
  }();
  (void)written;
  return folder.path().string();
}

}  // namespace ddem::harness::test
