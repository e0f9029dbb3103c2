#include "tests/harness/solvers/lammps_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <sstream>

#include "dem/assembly/contacts.h"
#include "harness/io/atomic_file.h"
#include "harness/model/assemble.h"
#include "harness/scene/read_scene.h"
#include "harness/solvers/lammps_ddem.h"
#include "harness/solvers/lammps_dump.h"
#include "harness/solvers/reduced.h"

namespace ddem::harness::test {

namespace fs = std::filesystem;

std::string lagged(const std::string& correction, const std::string& more) {
  return fmt::format("[deformation]\nscheme = \"lagged\"\ncorrection = \"{}\"\nyoung_modulus = 4e10\npoisson_ratio = 0.3\n{}", correction, more);
}

std::string implicit(const std::string& correction) {
  return fmt::format("[deformation]\nscheme = \"implicit\"\ncorrection = \"{}\"\nyoung_modulus = 4e10\npoisson_ratio = 0.3\n", correction);
}

PreparedRun prepared(const StripScene& s) {
  const std::string text = fmt::format(
      "[assembly]\n{}thickness = {}\n[material]\ndensity = 2000\n[contact]\nstiffness_ratio = {}\nnew_contacts = \"{}\"\n{}{}[boundary]\n"
      "top_bottom = \"{}\"\nright = \"fixed_x\"\n{}[time]\nstep_fraction = {}\nsteps = {}\nsample_every = {}\n[probes]\ndiscs = [{}]\n",
      s.assembly, s.thickness, s.ratio, s.new_contacts, s.contact, s.deformation, s.edges, s.load, s.step_fraction, s.steps, s.sample_every, s.discs);
  const SceneResult scene = parse_scene(text, "scene.toml", ".", {Purpose::simulation});
  EXPECT_TRUE(scene) << to_string(scene.violations);
  return prepare_run(*scene, build_assembly(*scene));
}

StripScene touching(const std::string& deformation, const std::string& contact, const char* edges) {
  StripScene s;
  s.new_contacts = "auto";
  s.deformation = deformation, s.contact += contact, s.edges = edges;
  return s;
}

PreparedRun shaken(const StripScene& scene) {
  PreparedRun run = prepared(scene);
  Bonds& b = run.run.assembly.bonds;
  std::vector<std::pair<int, int>> kept;
  for (std::size_t c = 0; c < b.size(); ++c) {
    if (c % 4 != 0) kept.emplace_back(b.i[c], b.j[c]);
  }
  b = bonds_between(run.run.assembly.packing, kept);
  ddem::InitialState& s = run.input.initial;
  std::mt19937 random(7);
  const auto shake = [&](std::vector<double>& v, const std::vector<std::uint8_t>& held) {
    v.resize(run.run.assembly.size());
    for (std::size_t d = 0; d < v.size(); ++d) {
      const double velocity = 40.0 * (static_cast<double>(random()) / static_cast<double>(std::mt19937::max()) - 0.5);  // m/s
      v[d] = held.empty() || held[d] == 0 ? velocity : 0.0;
    }
  };
  shake(s.vx, run.input.held.x), shake(s.vy, run.input.held.y);
  return run;
}

double difference(const std::vector<double>& a, const std::vector<double>& b) {
  EXPECT_EQ(a.size(), b.size());
  EXPECT_FALSE(a.empty());
  double most = 0.0, scale = 0.0;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) {
    if (!std::isfinite(a[k]) || !std::isfinite(b[k])) return HUGE_VAL;
    most = std::max(most, std::abs(a[k] - b[k]));
    scale = std::max(scale, std::abs(a[k]));
  }
  return scale > 0.0 ? most / scale : most;
}

/// Frame by frame, disc by disc.
Motion by_builtin(const PreparedRun& run) {
  SimulationInput input = run.input;
  input.receivers.clear();
  for (const int d : recorded_discs(run.input)) input.receivers.push_back({{d}});
  const SimulationResult result = builtin_solver().solve(run.run.assembly, input);
  EXPECT_FALSE(result.breakdown.has_value());
  Motion motion;
  for (std::size_t n = 0; n < result.signals.time.size(); ++n) {
    for (std::size_t r = 0; r < input.receivers.size(); ++r) {
      motion.u.push_back(result.signals.ux[r][n]), motion.u.push_back(result.signals.uy[r][n]);
      motion.theta.push_back(result.signals.theta[r][n]);
    }
  }
  return motion;
}

std::string replaced(std::string text, const std::string& old, const std::string& by) {
  const std::size_t at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  if (at == std::string::npos) return text;
  EXPECT_EQ(text.find(old, at + 1), std::string::npos) << old;
  return text.replace(at, old.size(), by);
}

std::string newton_on(std::string script) { return replaced(std::move(script), "newton off", "newton on"); }

LammpsFolder::LammpsFolder(const PreparedRun& run) : run_(run) { write_lammps_ddem(folder_.path(), {run.run.assembly, run.input, {}, "test"}); }

SubprocessResult LammpsFolder::run(int ranks, const Edit& edit, const std::string& lammps) const {
  const std::string script = read(kLammpsScript);
  write_file(folder_.path() / "in.test", edit ? edit(script) : script);
  std::vector<std::string> words{"-in", "in.test", "-log", "none"};
  std::string program = lammps;
  if (ranks > 1) {
    words.insert(words.begin(), {"--oversubscribe", "-np", std::to_string(ranks), program});
    program = "mpirun";
  }
  return run_confined(program, words, {folder_.path(), {}, 120.0});
}

Motion LammpsFolder::motion() const {
  Motion motion;
  const auto take = [&motion](std::size_t, std::span<const double> u) {
    motion.u.insert(motion.u.end(), {u[0], u[1]});
    motion.theta.push_back(u[2]);
  };
  read_dump(folder_.path() / "motion.txt", run_.run.assembly.size(), 3, take, [] {});
  return motion;
}

std::string LammpsFolder::read(const std::string& name) const {
  std::ifstream file(folder_.path() / name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

Motion by_lammps(const PreparedRun& run, int ranks, const Edit& edit) {
  const LammpsFolder folder(run);
  const SubprocessResult done = folder.run(ranks, edit);
  EXPECT_TRUE(done.succeeded()) << done.status() << done.standard_output << done.standard_error;
  return folder.motion();
}

namespace {

/// Rows of numbers that the script printed.
std::vector<std::vector<double>> printed_rows(const std::string& said) {
  std::vector<std::vector<double>> rows;
  std::istringstream lines(said);
  bool begun = false;  // by a line "Step ...", which later versions of LAMMPS indent
  for (std::string line; std::getline(lines, line) && !(begun && line.starts_with("Loop"));) {
    if (!begun) {
      std::string first;
      std::istringstream(line) >> first;
      begun = first == "Step";
      continue;
    }
    std::istringstream words(line);
    std::vector<double> row;
    for (double value = 0.0; words >> value;) row.push_back(value);
    if (!row.empty()) rows.push_back(row);
  }
  return rows;
}

}  // namespace

std::vector<std::vector<double>> thermo(const PreparedRun& run, int ranks, const std::string& before, const std::string& columns, const Edit& edit) {
  const LammpsFolder folder(run);
  const SubprocessResult done = folder.run(ranks, [&](std::string script) {
    if (edit) script = edit(std::move(script));
    return replaced(std::move(script), "thermo 100000000\nthermo_modify",
                    before + "thermo 10\nthermo_style custom step " + columns + "\nthermo_modify format float %.17g");
  });
  EXPECT_TRUE(done.succeeded()) << done.standard_output;
  return printed_rows(done.standard_output);
}

void OnLammps::SetUp() {
  if (std::string(kLammps).empty()) GTEST_SKIP() << "ddem-lammps was not built: it needs LAMMPS and MPI (Debian: liblammps-dev, libopenmpi-dev)";
  // Open MPI starts nothing for root otherwise; containers have no other user.
  ::setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
  ::setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
  // Ranks that wait ask over and over: beside other tests they would take five times as long.
  ::setenv("OMPI_MCA_mpi_yield_when_idle", "1", 1);
  // Looking for other networks takes half of the time of such short runs.
  ::setenv("OMPI_MCA_pml", "ob1", 1);
}

}  // namespace ddem::harness::test
