#include "fem_reference/run_case.h"

#include <chrono>
#include <cmath>
#include <numeric>

#include "fem_reference/excitation.h"
#include "fem_reference/kernel/critical_step.h"
#include "fem_reference/march.h"

namespace ddem::fem {

namespace {

// Of the processes together: nodes that they own, or all of something that each has its own of.
std::uint64_t whole(const StripModel& model, std::size_t count, bool nodes) {
  if (!model.processes) return count;
  const std::vector<double>& owned = model.processes->owned();
  double sum = nodes ? std::accumulate(owned.begin(), owned.end(), 0.0) : static_cast<double>(count);
  model.processes->sum({&sum, 1});
  return static_cast<std::uint64_t>(sum);
}

// The same whichever process has the node.
std::vector<std::uint64_t> keys_by_place(const StripCase& strip, const StripModel& model) {
  constexpr double resolution = 1e7;
  std::vector<std::uint64_t> keys;
  for (std::size_t node = 0; node < model.x.size(); ++node) {
    const auto x = static_cast<std::uint64_t>(std::llround(model.x[node] / strip.length * resolution));
    const auto y = static_cast<std::uint64_t>(std::llround(model.y[node] / strip.width * resolution));
    keys.push_back(x << 32 | y);
  }
  return keys;
}

}  // namespace

CaseResult run_case(const StripCase& strip, const StripModel& model, Team& team) {
  const auto start = std::chrono::steady_clock::now();
  const PlaneMaterial material = plane_material(strip.young_modulus, strip.poisson_ratio, strip.density, strip.plane);
  ElasticOperator stiffness(model.mesh, material);
  stiffness.use(team);
  if (model.processes) stiffness.use(*model.processes);
  const std::vector<double> inverse = inverse_mass(strip, model, stiffness);
  CaseResult result;
  result.dofs = 2 * whole(model, stiffness.node_count(), true);
  result.elements = whole(model, model.mesh.element_count(), false);
  const auto [nx, ny] = strip.elements;
  const bool free_end = (strip.left == End::free && !strip.drive) || strip.right == End::free;
  if (strip.mesh.empty() && nx >= columns_to_cut && free_end) {
    // Each of several processes finds the same.
    result.critical_time_step =
        critical_time_step({strip.degree, nx, ny, strip.length / nx, strip.width / ny, strip.periodic}, material, team);
  } else {
    result.critical_time_step = critical_time_step(stiffness, inverse, keys_by_place(strip, model));
  }
  const StripProblem problem{strip, model, stiffness, inverse};
  if (strip.time.integrator == Integrator::exact) {
    march_exact(problem, result);
  } else {
    march_verlet(problem, result);
  }
  result.solve_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace ddem::fem
