#include "harness/bench/bench.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "harness/bench/triad.h"
#include "harness/io/errors.h"
#include "harness/provenance/provenance.h"

namespace ddem::harness::bench {
namespace {

constexpr std::size_t kSchemes = 3;  // rigid, lagged, implicit

void measure_kernels(const BenchPlan& plan, BenchResults& results, const std::function<void()>& progress) {
  results.kernels = time_kernels(plan.kernel_plans, progress);
  try {
    results.fem_kernels = time_fem(plan.fem_kernels, progress);
  } catch (const MachineError& error) {  // built without deal.II
    results.fem_failure = error.what();
  }
}

void measure_precision(const BenchPlan& plan, BenchResults& results, const std::function<void()>& progress) {
  try {
    results.work_precision = measure_fem(plan.fem_meshes, plan.fem_repetitions, progress);
  } catch (const MachineError& error) {  // built without deal.II
    results.fem_failure = error.what();
  }
  const auto discs = measure_discs(plan.discs, progress);
  results.work_precision.insert(results.work_precision.end(), discs.begin(), discs.end());
}

Json kernel_json(const KernelTime& k) {
  return {{"law", k.law},
          {"packing", name_of(k.arrangement)},
          {"stiffness", k.per_bond_stiffness ? "per bond" : "uniform"},
          {"discs", k.discs},
          {"bonds", k.bonds},
          {"threads", k.threads},
          {"nanoseconds_per_bond_step", k.nanoseconds_per_bond_step},
          {"best_nanoseconds_per_bond_step", k.best},
          {"over_dem", k.over_dem},
          {"rounds", k.rounds},
          {"bytes_per_bond", k.bytes_per_bond}};
}

Json fem_kernel_json(const FemKernelTime& k) {
  return {{"degree", k.mesh.degree},
          {"elements", k.mesh.elements},
          {"dofs", k.dofs},
          {"steps", k.steps},
          {"threads", k.threads},
          {"dof_steps_per_second", k.dof_steps_per_second},
          {"over_one_thread", k.over_one_thread},
          {"same_bits", k.same_bits}};
}

Json precision_json(const PrecisionPoint& p) {
  Json j{{"solver", p.solver},
         {"scheme", p.scheme},
         {"mesh", p.mesh},
         {"discs_or_dofs", p.discs_or_dofs},
         {"step_fraction", p.step_fraction},
         {"steps", p.steps},
         {"seconds", number_or_status(p.seconds, p.status)},
         {"status", p.status}};
  j["error"] = p.status == "ok" ? number_or_status(p.error, "not measured") : Json{{"status", p.status}};
  j["error_to_continuum"] = p.status == "ok" ? number_or_status(p.error_to_continuum, "not measured") : Json{{"status", p.status}};
  return j;
}

Json peer_json(const PeerTime& p) {
  return {{"program", p.program},
          {"version", p.version},
          {"law", p.law},
          {"discs", p.discs},
          {"bonds", p.bonds},
          {"steps", p.steps},
          {"nanoseconds_per_bond_step", p.nanoseconds_per_bond_step},
          {"ddem_nanoseconds_per_bond_step", p.ddem_nanoseconds_per_bond_step},
          {"ratio", p.ratio},
          {"displacement_difference", number_or_status(p.difference, "the motions cannot be compared")}};
}

Json scaling_json(const std::vector<ScalingPoint>& points) {
  Json list = Json::array();
  for (const ScalingPoint& p : points) {
    const bool ok = p.status == "ok";
    list.push_back({{"task", p.task},
                    {"packing", name_of(p.arrangement)},
                    {"discs", p.discs},
                    {"seconds", ok ? Json(p.seconds) : Json{{"status", p.status}}},
                    {"peak_bytes", ok ? Json(p.bytes) : Json{{"status", p.status}}}});
  }
  return list;
}

}  // namespace

std::size_t bench_work(const BenchPlan& plan) {
  std::size_t work = 1;
  if (plan.kernels) work += plan.kernel_plans.size() + static_cast<std::size_t>(plan.fem_kernels.rounds);
  if (plan.work_precision) work += static_cast<std::size_t>(plan.fem_repetitions) + kSchemes * plan.discs.columns.size();
  if (plan.peers) {
    for (const PeerPlan& peer : plan.peer_plans) work += peer.sizes.size();
  }
  if (plan.scaling) work += scaling_work(plan.sizes);
  return work;
}

BenchResults run_bench(const BenchPlan& plan, const std::function<void()>& progress) {
  const auto start = std::chrono::steady_clock::now();
  BenchResults results;
  // First: a program that is started counts what the starting one holds as memory of its own.
  if (plan.scaling) results.scaling = measure_scaling(plan.sizes, progress);
  results.triad_threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  results.triad_one_thread = triad_gb_per_s(1);
  results.triad = std::max(results.triad_one_thread, triad_gb_per_s(results.triad_threads));
  progress();
  if (plan.kernels) measure_kernels(plan, results, progress);
  if (plan.work_precision) measure_precision(plan, results, progress);
  results.peers.reason = "not asked for";
  if (plan.peers) results.peers = time_peers(plan.peer_plans, progress);
  results.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return results;
}

std::vector<PrecisionPoint> measure_briefly() {
  const std::vector<FemMesh> meshes{{1, {66, 8}}, {1, {132, 16}}, {2, {33, 4}}, {2, {66, 8}}, {2, {132, 16}}, {4, {17, 2}},
                                    {4, {33, 4}}, {4, {66, 8}},   {8, {8, 1}},  {8, {17, 2}}, {8, {33, 4}}};
  std::vector<PrecisionPoint> points;
  const auto add = [&](const char* solver, const auto& measure) {
    try {
      const std::vector<PrecisionPoint> more = measure();
      points.insert(points.end(), more.begin(), more.end());
    } catch (const std::exception& error) {  // it judges nothing: no reason to lose a campaign
      PrecisionPoint failed;
      failed.solver = solver;
      failed.status = error.what();
      points.push_back(failed);
    }
  };
  add("FE", [&] { return measure_fem(meshes, 1, [] {}); });
  add("DEM", [&] { return measure_discs({{62}, {1.0, 0.5, 0.2, 0.05}, 0.0}, [] {}); });
  return points;
}

Json bench_json(const BenchResults& r) {
  Json j{{"schema_version", 1}, {"provenance", Json::object()}};
  for (const auto& [key, value] : provenance()) j["provenance"][key] = value;
  j["kernels"] = Json::array();
  for (const KernelTime& k : r.kernels) j["kernels"].push_back(kernel_json(k));
  j["fem_kernels"] = Json::array();
  for (const FemKernelTime& k : r.fem_kernels) j["fem_kernels"].push_back(fem_kernel_json(k));
  j["work_precision"] = Json::array();
  for (const PrecisionPoint& p : r.work_precision) j["work_precision"].push_back(precision_json(p));
  j["scaling"] = scaling_json(r.scaling);
  if (!r.fem_failure.empty()) j["fem_reason"] = r.fem_failure;
  j["peers"] = Json::array();
  for (const PeerTime& p : r.peers.times) j["peers"].push_back(peer_json(p));
  if (!r.peers.reason.empty()) j["peers_reason"] = r.peers.reason;
  j["triad_gb_per_s"] = number_or_status(r.triad, "the arrays were not computed right");
  j["triad_gb_per_s_one_thread"] = number_or_status(r.triad_one_thread, "the arrays were not computed right");
  j["triad_threads"] = r.triad_threads;
  j["wall_seconds"] = r.wall_seconds;
  return j;
}

}  // namespace ddem::harness::bench
