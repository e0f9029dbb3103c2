#include "tests/harness/cli/program.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>

namespace ddem::harness::test {

std::string small_scene() {
  return R"([assembly]
packing = "hexagonal"
columns = 30
rows = 8
radius = "0.1 mm"
[material]
density = 2000.0
[contact]
normal_stiffness = 1e10
stiffness_ratio = 0.25
[boundary]
top_bottom = "periodic"
[initial]
wave = "longitudinal"
amplitude = "1 um"
[probes]
pairs = 3
)";
}

std::vector<Disc> small_lattice() {
  constexpr double r = 1e-4;
  std::vector<Disc> discs;
  for (int row = 0; row < 8; ++row) {
    for (int column = 0; column < 30; ++column) {
      discs.push_back({r * (2 * column + 1 + row % 2), r * (1 + row * std::sqrt(3.0)), r});
    }
  }
  return discs;
}

std::string disc_table(const std::vector<Disc>& discs) {
  std::string text = "x,y,radius\n";
  for (const Disc& d : discs) text += fmt::format("{},{},{}\n", d.x, d.y, d.radius);
  return text;
}

std::string file_scene() {
  return replaced(
      small_scene(), "packing = \"hexagonal\"\ncolumns = 30\nrows = 8\nradius = \"0.1 mm\"\n",
      fmt::format("packing = \"file\"\nfile = \"discs.csv\"\nwidth = {}\n", 8 * std::sqrt(3.0) * 1e-4));
}

std::string replaced(std::string text, std::string_view old, std::string_view by) {
  const auto at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  if (at == std::string::npos) return text;
  EXPECT_EQ(text.find(old, at + 1), std::string::npos) << old << " stands twice";
  return text.replace(at, old.size(), by);
}

std::string with_table(const std::string& scene, std::string_view lines) {
  return replaced(scene, "[probes]", fmt::format("{}\n[probes]", lines));
}

std::string rubbish(std::size_t bytes) {
  std::string text;
  std::uint64_t state = 0x9E3779B97F4A7C15u;
  while (text.size() < bytes) {
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    text.push_back(static_cast<char>(state >> 56));
  }
  return text;
}

void Cli::write(const std::string& name, const std::string& text) const {
  std::ofstream(in_folder(name), std::ios::binary) << text;
}

std::string Cli::read(const std::string& name) const {
  std::ifstream file(in_folder(name), std::ios::binary);
  EXPECT_TRUE(file) << name;
  return {std::istreambuf_iterator<char>(file), {}};
}

SubprocessResult Cli::ddem(const std::vector<std::string>& arguments) const {
  return run_program(DDEM_PROGRAM, arguments);
}

std::map<std::string, std::string> Cli::contents() const {
  std::map<std::string, std::string> all;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_.path())) {
    const std::string name = std::filesystem::relative(entry.path(), folder_.path()).string();
    all[name] = entry.is_regular_file() ? read(name) : "";
  }
  return all;
}

void Cli::expect_contents(const std::map<std::string, std::string>& expected) const {
  const auto now = contents();
  for (const auto& [name, text] : now) {
    const auto was = expected.find(name);
    const bool is_new = was == expected.end();
    EXPECT_FALSE(is_new) << name << " was written";
    EXPECT_TRUE(is_new || was->second == text) << name << " was changed";
  }
  for (const auto& [name, text] : expected) EXPECT_TRUE(now.contains(name)) << name << " was removed";
}

void Cli::expect_refused(const std::vector<std::string>& parts, int exit_code) const {
  write("earlier.h5", "an earlier result");
  const auto before = contents();
  const auto run = ddem({"run", path("scene.toml"), "-o", path("earlier.h5"), "--signals", path("new.csv"), "--force"});
  EXPECT_EQ(run.signal, 0) << run.status();
  EXPECT_EQ(run.exit_code, exit_code) << run.standard_error;
  EXPECT_EQ(run.standard_output, "");
  for (const std::string& part : parts) EXPECT_THAT(run.standard_error, testing::HasSubstr(part));
  expect_contents(before);
}

}  // namespace ddem::harness::test
