#include "fem_reference/run_case.h"

#include <chrono>

#include "fem_reference/excitation.h"
#include "fem_reference/kernel/critical_step.h"
#include "fem_reference/march.h"

namespace ddem::fem {

CaseResult run_case(const StripCase& strip, const StripModel& model, Team& team) {
  const auto start = std::chrono::steady_clock::now();
  ElasticOperator stiffness(
      model.mesh, plane_material(strip.young_modulus, strip.poisson_ratio, strip.density, strip.plane));
  stiffness.use(team);
  const std::vector<double> inverse = inverse_mass(strip, model, stiffness);
  CaseResult result;
  result.dofs = 2 * stiffness.node_count();
  result.elements = model.mesh.element_count();
  result.critical_time_step = critical_time_step(stiffness, inverse);
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
