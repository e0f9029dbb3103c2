#include "harness/bench/scaling.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <filesystem>

#include "harness/io/atomic_file.h"
#include "harness/io/errors.h"
#include "harness/io/own_files.h"
#include "harness/io/subprocess.h"
#include "harness/io/temporary_folder.h"

namespace ddem::harness::bench {
namespace {

constexpr std::size_t kFirstSize = 1000;
constexpr double kLongest = 120.0;  // s
constexpr int kRunSteps = 300;

struct Task {
  std::string name, command;
  std::string_view scheme;  ///< of deformable discs; empty: rigid
  Arrangement arrangement;
};

std::vector<Task> all_tasks() {
  std::vector<Task> tasks{{"pack", "pack", "", Arrangement::random}};  // first: it leaves the packing for the others
  for (const Arrangement a : {Arrangement::lattice, Arrangement::random}) {
    tasks.push_back({"moduli", "moduli", "", a});
    tasks.push_back({"stability", "stability", "lagged", a});
    tasks.push_back({"run DEM", "run", "", a});
    tasks.push_back({"run lagged", "run", "lagged", a});
    tasks.push_back({"run implicit", "run", "implicit", a});
  }
  return tasks;
}

std::string assembly_table(Arrangement arrangement, std::size_t discs, bool periodic) {
  std::string text = "[assembly]\n";
  if (arrangement == Arrangement::lattice) {
    const auto [columns, rows] = lattice_size(discs);
    text += fmt::format("packing = \"hexagonal\"\ncolumns = {}\nrows = {}\nradius = {}\n", columns, rows, kRadius);
  } else {
    const auto [length, width] = random_size(discs);
    text += fmt::format("packing = \"random\"\nlength = {}\nwidth = {}\ndiscs = {}\n", length, width, discs);
  }
  return text + (periodic ? "periodic = \"xy\"\n" : "");
}

std::string scene_of(const Task& task, std::size_t discs) {
  std::string text = assembly_table(task.arrangement, discs, task.command == "moduli");
  text += fmt::format("[material]\ndensity = {}\n[contact]\nnormal_stiffness = {}\nstiffness_ratio = {}\n", kDensity, kNormalStiffness, kShearRatio);
  if (!task.scheme.empty()) {
    text += fmt::format("[deformation]\nscheme = \"{}\"\ncorrection = \"full\"\nyoung_modulus = {}\npoisson_ratio = {}\n", task.scheme,
                        kNormalStiffness / kSoftness, kDiscPoisson);
  }
  if (task.command == "run") {
    text += fmt::format("[boundary]\nright = \"free\"\n[initial]\nwave = \"longitudinal\"\nshape = \"cosine\"\nwidth = {}\namplitude = 1e-9\n"
                        "[time]\nsteps = {}\n[probes]\ndiscs = [0]\n",
                        20.0 * kRadius, kRunSteps);
  }
  return text;
}

/// The command's last words, as the reason why it has no measurement.
std::string reason_of(const SubprocessResult& result) {
  std::string text = result.standard_error;
  while (!text.empty() && text.back() == '\n') text.pop_back();
  if (text.empty()) return result.status();
  const std::size_t line = text.rfind('\n');
  return line == std::string::npos ? text : text.substr(line + 1);
}

void measure(const Task& task, const std::filesystem::path& folder, ScalingPoint& point) {
  const std::string scene = folder / "scene.toml";
  write_file(scene, scene_of(task, point.discs));
  std::vector<std::string> arguments{fmt::format("XDG_CACHE_HOME={}", (folder / "cache").string()), (program_folder() / "ddem").string(),
                                     task.command, scene};
  if (task.command == "pack") arguments.insert(arguments.end(), {"--force", "-o", folder / "discs.csv"});
  const auto start = std::chrono::steady_clock::now();
  const SubprocessResult result = run_program("env", arguments);
  point.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  point.bytes = result.peak_memory;
  if (!result.succeeded()) point.status = reason_of(result);
}

}  // namespace

ScalingPlan scaling_plan(std::size_t largest) {
  ScalingPlan plan{{}, kLongest};
  for (std::size_t discs = kFirstSize; discs <= largest; discs *= 10) plan.discs.push_back(discs);
  return plan;
}

std::size_t scaling_work(const ScalingPlan& plan) { return plan.discs.size() * all_tasks().size(); }

std::vector<ScalingPoint> measure_scaling(const ScalingPlan& plan, const std::function<void()>& progress) {
  if (!std::filesystem::exists(program_folder() / "ddem")) throw MachineError("the program ddem does not stand beside this one");
  const TemporaryFolder folder("ddem-scaling-");
  const std::vector<Task> tasks = all_tasks();
  std::vector<ScalingPoint> points;
  std::vector<ScalingPoint> before(tasks.size());  // of each task, the last size that was measured
  for (const std::size_t discs : plan.discs) {
    for (std::size_t t = 0; t < tasks.size(); ++t) {
      ScalingPoint point{.task = tasks[t].name, .arrangement = tasks[t].arrangement, .discs = discs};
      const double expected = before[t].discs == 0 ? 0.0 : before[t].seconds * static_cast<double>(discs) / static_cast<double>(before[t].discs);
      if (before[t].status != "ok") {
        point.status = before[t].status;
      } else if (expected > plan.longest) {
        point.status = fmt::format("would take more than {:.0f} s", plan.longest);
      } else {
        measure(tasks[t], folder.path(), point);
      }
      points.push_back(before[t] = point);
      progress();
    }
  }
  return points;
}

std::optional<double> growth(const ScalingPoint& a, const ScalingPoint& b, double ScalingPoint::* value) {
  if (a.status != "ok" || b.status != "ok" || a.discs == b.discs) return std::nullopt;
  return std::log(b.*value / (a.*value)) / std::log(static_cast<double>(b.discs) / static_cast<double>(a.discs));
}

}  // namespace ddem::harness::bench
