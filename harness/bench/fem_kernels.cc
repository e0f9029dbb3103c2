#include "harness/bench/fem_kernels.h"

#include <algorithm>
#include <thread>

#include "harness/io/errors.h"

namespace ddem::harness::bench {
namespace {

constexpr int kSampleEvery = 50;  // the filter at the receivers is not what is timed
constexpr double kDifference = 1e-9;  // of the pulses of repetitions: problems that are the same would be solved once

}  // namespace

FemKernelPlan fem_kernel_plan() {
  FemKernelPlan plan{{{4, {66, 8}}, {8, {33, 4}}}, {1}, 15e-6, 2, 8};
  if (std::thread::hardware_concurrency() > 1) plan.threads.push_back(2);
  return plan;
}

std::vector<FemKernelTime> time_fem(const FemKernelPlan& plan, const std::function<void()>& progress) {
  std::vector<FemCase> cases;
  for (int repetition = 0; repetition < plan.repetitions; ++repetition) {
    for (const FemMesh& mesh : plan.meshes) {
      cases.push_back(pulse_case(mesh, Wave::shear));
      cases.back().end = plan.end;
      std::get<InitialPulse>(cases.back().load).center *= 1.0 + kDifference * repetition;
      cases.back().sample_every = kSampleEvery;
    }
  }
  const std::size_t meshes = plan.meshes.size();
  // [threads][mesh]
  std::vector<std::vector<FemKernelTime>> times(plan.threads.size(), std::vector<FemKernelTime>(meshes));
  std::vector<FemResult> alone;
  for (int round = 0; round < plan.rounds; ++round) {
    for (std::size_t t = 0; t < plan.threads.size(); ++t) {
      const std::vector<FemResult> results = run_fem(cases, {}, plan.threads[t]);
      if (t == 0) alone = results;
      for (std::size_t k = 0; k < cases.size(); ++k) {
        const FemResult& r = results[k];
        if (r.status != "ok") throw SolverError("ddem-fem: " + r.status);
        FemKernelTime& time = times[t][k % meshes];
        time.mesh = plan.meshes[k % meshes];
        time.threads = plan.threads[t];
        time.dofs = static_cast<std::size_t>(r.dofs);
        time.steps = r.steps;
        time.dof_steps_per_second = std::max(time.dof_steps_per_second, static_cast<double>(r.dofs) * static_cast<double>(r.steps) / r.solve_seconds);
        time.same_bits = time.same_bits && r.point_uy == alone[k].point_uy;
      }
    }
    progress();
  }
  std::vector<FemKernelTime> all;
  for (const auto& of_threads : times) {
    for (std::size_t k = 0; k < meshes; ++k) {
      all.push_back(of_threads[k]);
      all.back().over_one_thread = of_threads[k].dof_steps_per_second / times.front()[k].dof_steps_per_second;
    }
  }
  return all;
}

}  // namespace ddem::harness::bench
