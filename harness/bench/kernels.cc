#include "harness/bench/kernels.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>

#include "dem/core/team.h"
#include "dem/simulation/stepper.h"
#include "harness/bench/assemblies.h"
#include "harness/measure/median.h"

namespace ddem::harness::bench {
namespace {

constexpr double kKernelStepFraction = 0.3;  // all laws here are stable at it

struct Competitor {
  Law law;
  bool per_bond;
  std::size_t reference;  ///< place of the law that it is compared with
  std::unique_ptr<Stepper> stepper;
};

std::vector<Competitor> competitors(const KernelPlan& plan, const ddem::Assembly& assembly) {
  std::vector<Competitor> all;
  constexpr std::size_t kNoShear = 0, kShear = 1;
  for (const bool per_bond : {false, true}) {
    if (per_bond && !plan.per_bond) break;
    all.push_back({rigid(false, per_bond), per_bond, kShear, {}});
    all.push_back({rigid(true, per_bond), per_bond, kShear, {}});
    if (!plan.deformable) continue;
    all.push_back({deformable(Scheme::lagged, true, per_bond), per_bond, kShear, {}});
    all.push_back({deformable(Scheme::implicit, true, per_bond), per_bond, kShear, {}});
  }
  if (plan.deformable) {
    for (const Scheme scheme : {Scheme::lagged, Scheme::implicit}) all.push_back({deformable(scheme, false), false, kNoShear, {}});
  }
  for (Competitor& c : all) {
    SimulationInput in;
    in.contact = c.law.contact;
    in.deformation = c.law.deformation;
    in.initial = smooth_state(assembly);
    if (in.deformation.active()) in.new_contacts = ContactWatch::bound;  // as in every run
    in.time_step = step_of(assembly, kKernelStepFraction);
    c.stepper = std::make_unique<Stepper>(assembly, in, best_instruction_set());
  }
  return all;
}

void take_steps(Stepper& stepper, long steps, Team& team) {
  long left = steps;
  const auto plan_sweep = [&] { stepper.take_steps(static_cast<int>(std::clamp<long>(left, 1, stepper.steps_at_once()))); };
  stepper.share_among(team.size());
  plan_sweep();
  team.run([&](int thread) {
    while (left > 0) {
      stepper.advance(thread);
      team.meet(thread, [&] {
        if (!stepper.finish_stage()) return;
        left -= stepper.steps_taken();
        plan_sweep();
      });
    }
  });
}

/// A slow spell of the machine then hits all alike.
void interleave_repetitions() {
  std::string program = "ddem", option = "--benchmark_enable_random_interleaving=true";
  std::array<char*, 2> arguments{program.data(), option.data()};
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
}

/// seconds[competitor][repetition], by the order in which they were registered.
class Seconds : public benchmark::BenchmarkReporter {
 public:
  explicit Seconds(std::size_t competitors) : seconds_(competitors) {}
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type == Run::RT_Iteration) seconds_.at(static_cast<std::size_t>(run.family_index)).push_back(run.GetAdjustedRealTime());
    }
  }
  const std::vector<std::vector<double>>& all() const { return seconds_; }

 private:
  std::vector<std::vector<double>> seconds_;
};

/// seconds[competitor][repetition], after a run of each that is not counted.
std::vector<std::vector<double>> measure(std::vector<Competitor>& all, const KernelPlan& plan, int threads) {
  Team team(threads);
  for (Competitor& c : all) {
    take_steps(*c.stepper, plan.steps, team);
    benchmark::RegisterBenchmark(c.law.name.c_str(), [&c, &plan, &team](benchmark::State& state) {
      for (auto _ : state) take_steps(*c.stepper, plan.steps, team);
    })->Iterations(1)->Repetitions(plan.rounds)->UseRealTime()->Unit(benchmark::kSecond);
  }
  Seconds seconds(all.size());
  interleave_repetitions();
  benchmark::RunSpecifiedBenchmarks(&seconds);
  benchmark::ClearRegisteredBenchmarks();
  return seconds.all();
}

}  // namespace

std::vector<KernelPlan> kernel_plans() {
  std::vector<int> threads{1};
  if (std::thread::hardware_concurrency() > 1) threads.push_back(2);
  std::vector<KernelPlan> plans;
  for (const Arrangement arrangement : {Arrangement::lattice, Arrangement::random}) {
    plans.push_back({arrangement, 682, 1500, 21, true, true, threads});
    plans.push_back({arrangement, 10000, 100, 15, true, false, threads});
    plans.push_back({arrangement, 100000, 16, 15, true, false, threads});
    plans.push_back({arrangement, 1000000, 16, 5, true, false, threads});
  }
  return plans;
}

std::vector<KernelTime> time_kernels(const std::vector<KernelPlan>& plans, const std::function<void()>& progress) {
  std::vector<KernelTime> times;
  for (const KernelPlan& plan : plans) {
    const ddem::Assembly assembly = strip_of(plan.arrangement, plan.discs);
    std::vector<Competitor> all = competitors(plan, assembly);
    const double bond_steps = static_cast<double>(assembly.bonds.size()) * static_cast<double>(plan.steps);
    for (const int threads : plan.threads) {
      const auto seconds = measure(all, plan, threads);
      for (std::size_t c = 0; c < all.size(); ++c) {
        const double time = median(seconds[c]);
        times.push_back({all[c].law.name, plan.arrangement, all[c].per_bond, assembly.size(), assembly.bonds.size(), threads, 1e9 * time / bond_steps,
                         1e9 * *std::min_element(seconds[c].begin(), seconds[c].end()) / bond_steps, time / median(seconds[all[c].reference]),
                         plan.rounds, static_cast<double>(all[c].stepper->array_bytes()) / static_cast<double>(assembly.bonds.size())});
      }
    }
    progress();
  }
  return times;
}

}  // namespace ddem::harness::bench
