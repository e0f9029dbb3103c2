#include "harness/bench/kernels.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>

#include "dem/core/team.h"
#include "dem/simulation/stepper.h"
#include "harness/bench/lattice.h"

namespace ddem::harness::bench {
namespace {

constexpr double kStepFraction = 0.3;  // all laws here are stable at it

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
    all.push_back({rigid(false, per_bond), per_bond, kShear, {}});
    all.push_back({rigid(true, per_bond), per_bond, kShear, {}});
    if (!plan.deformable) break;
    all.push_back({deformable(Scheme::lagged, true, per_bond), per_bond, kShear, {}});
    if (!per_bond || plan.implicit_per_bond) all.push_back({deformable(Scheme::implicit, true, per_bond), per_bond, kShear, {}});
  }
  if (plan.deformable) {
    for (const Scheme scheme : {Scheme::lagged, Scheme::implicit}) all.push_back({deformable(scheme, false), false, kNoShear, {}});
  }
  for (Competitor& c : all) {
    SimulationInput in;
    in.contact = c.law.contact;
    in.deformation = c.law.deformation;
    in.initial = smooth_state(assembly);
    in.time_step = lattice_step(kStepFraction);
    c.stepper = std::make_unique<Stepper>(assembly, in, best_instruction_set());
  }
  return all;
}

double seconds_of(Stepper& stepper, long steps, Team& team) {
  long left = steps;
  const auto take_steps = [&] { stepper.take_steps(static_cast<int>(std::clamp<long>(left, 1, stepper.steps_at_once()))); };
  stepper.share_among(team.size());
  take_steps();
  const auto start = std::chrono::steady_clock::now();
  team.run([&](int thread) {
    while (left > 0) {
      stepper.advance(thread);
      team.meet(thread, [&] {
        left -= stepper.finish_stage() ? stepper.steps_taken() : 0;
        take_steps();
      });
    }
  });
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// seconds[competitor][round], after a round that is not counted.
std::vector<std::vector<double>> take_turns(std::vector<Competitor>& all, const KernelPlan& plan, int threads) {
  std::vector<std::vector<double>> seconds(all.size());
  Team team(threads);
  for (int round = -1; round < plan.rounds; ++round) {
    for (std::size_t c = 0; c < all.size(); ++c) {
      const double time = seconds_of(*all[c].stepper, plan.steps, team);
      if (round >= 0) seconds[c].push_back(time);
    }
  }
  return seconds;
}

}  // namespace

double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

std::vector<KernelPlan> kernel_plans() {
  std::vector<int> threads{1};
  if (std::thread::hardware_concurrency() > 1) threads.push_back(2);
  return {{682, 1500, 15, true, true, threads}, {100000, 16, 5, true, false, threads}, {1000000, 16, 3, false, false, threads}};
}

std::vector<KernelTime> time_kernels(const std::vector<KernelPlan>& plans, const std::function<void()>& progress) {
  std::vector<KernelTime> times;
  for (const KernelPlan& plan : plans) {
    const auto [columns, rows] = lattice_size(plan.discs);
    const ddem::Assembly assembly = lattice(columns, rows);
    std::vector<Competitor> all = competitors(plan, assembly);
    const double bond_steps = static_cast<double>(assembly.bonds.size()) * static_cast<double>(plan.steps);
    for (const int threads : plan.threads) {
      const auto seconds = take_turns(all, plan, threads);
      for (std::size_t c = 0; c < all.size(); ++c) {
        std::vector<double> ratios;
        const std::vector<double>& reference = seconds[all[c].reference];
        for (std::size_t round = 0; round < seconds[c].size(); ++round) ratios.push_back(seconds[c][round] / reference[round]);
        times.push_back({all[c].law.name, all[c].per_bond, assembly.size(), assembly.bonds.size(), threads,
                         1e9 * median(seconds[c]) / bond_steps,
                         1e9 * *std::min_element(seconds[c].begin(), seconds[c].end()) / bond_steps, median(ratios), plan.rounds});
      }
    }
    progress();
  }
  return times;
}

}  // namespace ddem::harness::bench
