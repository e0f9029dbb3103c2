#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>

#include "dem/core/time_filter.h"
#include "fem_reference/excitation.h"
#include "fem_reference/march.h"
#include "fem_reference/receivers.h"
#include "fem_reference/sampling.h"

namespace ddem::fem {
namespace {

// The states of a march at the very critical step would grow linearly in its fastest mode.
constexpr double march_fraction = 0.99;
// Multiplications of coefficients and states: minutes.
constexpr double most_filter_work = 1e12;

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// The displacement is factor sum_k a_k(t) T_k start + motion(t) edge.
struct Response {
  std::vector<double> start;
  std::function<void(std::span<const double> times, double time_step, std::span<double> a)> coefficients;
  double factor = 1.0;
  std::vector<double> edge;                ///< receivers' values of a unit motion of the driven edge
  std::function<double(double)> motion;
  double largest_step = HUGE_VAL;
};

// At rest, the prescribed edge e g(t) accelerates the free degrees of freedom by -M^-1 K e g(t).
Response driven(const StripProblem& problem) {
  Response r;
  const EdgeDrive& drive = *problem.strip.drive;
  const Sin2 pulse = motion(drive);
  const std::vector<double> edge = driven_edge(problem.strip, problem.model, problem.stiffness);
  r.start.resize(edge.size());
  problem.stiffness.apply(edge, r.start);
  for (std::size_t k = 0; k < r.start.size(); ++k) r.start[k] *= -problem.inverse_mass[k];
  r.coefficients = [pulse](std::span<const double> t, double dt, std::span<double> a) { drive_coefficients(pulse, t, dt, a); };
  r.factor = drive.amplitude;
  const ReceiverReader receivers(problem.model, problem.stiffness);
  r.edge.resize(receivers.values());
  receivers.evaluate(edge, r.edge.data());
  if (problem.model.processes) problem.model.processes->sum(r.edge);
  r.motion = [pulse, amplitude = drive.amplitude](double t) { return amplitude * pulse(t); };
  r.largest_step = largest_step_for(pulse);
  return r;
}

Response released(const StripProblem& problem) {
  Response r;
  const InitialPulse& pulse = *problem.strip.initial;
  r.start = initial_field(problem.strip, problem.model, pulse);
  r.coefficients = pulse.field == Field::velocity ? impulse_coefficients : release_coefficients;
  return r;
}

// Receivers' values of T_0 start .. T_(count-1) start, one row a state.
Matrix march(const StripProblem& problem, const Response& response, std::size_t count, CaseResult& result) {
  const ReceiverReader receivers(problem.model, problem.stiffness);
  std::vector<double> rows(count * receivers.values());
  Leapfrog leapfrog(problem.stiffness, problem.inverse_mass, {response.start, {}}, result.time_step);
  receivers.evaluate(leapfrog.displacement(), rows.data());
  EnergyAudit audit(1, count - 1);
  double* row = nullptr;
  const std::function<void(int)> look = [&](int thread) { receivers.evaluate_share(thread, leapfrog.displacement(), row); };
  for (std::size_t k = 1; k < count; ++k) {
    row = &rows[k * receivers.values()];
    leapfrog.step(look);
    receivers.evaluate_rest(leapfrog.displacement(), row);
    audit.watch(leapfrog);
  }
  if (problem.model.processes) problem.model.processes->sum(rows);
  result.steps = leapfrog.steps_done();
  result.energy_drift = audit.drift();
  return Eigen::Map<const Matrix>(rows.data(), static_cast<Eigen::Index>(count),
                                  static_cast<Eigen::Index>(receivers.values()));
}

// One thread's share of the samples, block by block: each block is a product of matrices of its own.
void filter_share(const Response& response, const Matrix& states, CaseResult& result, const Team& team, int thread) {
  constexpr Eigen::Index block = 64;
  const auto samples = static_cast<Eigen::Index>(result.time.size());
  Eigen::Map<Matrix> signals(result.signals.data(), samples, states.cols());
  Eigen::MatrixXd coefficients(block, states.rows());
  const auto [first_block, last_block] = team.part(static_cast<std::size_t>((samples + block - 1) / block), thread);
  for (Eigen::Index first = block * static_cast<Eigen::Index>(first_block); first < block * static_cast<Eigen::Index>(last_block); first += block) {
    const Eigen::Index count = std::min(block, samples - first);
    // Later states do not reach back to these samples.
    const Eigen::Index reach = std::min<Eigen::Index>(
        states.rows(), static_cast<Eigen::Index>(states_for(result.time[first + count - 1], result.time_step)));
    const std::span<const double> times(&result.time[static_cast<std::size_t>(first)], static_cast<std::size_t>(count));
    response.coefficients(times, result.time_step, {coefficients.data(), static_cast<std::size_t>(count * reach)});
    auto out = signals.middleRows(first, count);
    out.noalias() = response.factor * (Eigen::Map<const Eigen::MatrixXd>(coefficients.data(), count, reach) * states.topRows(reach));
    if (!response.motion) continue;
    const Eigen::Map<const Eigen::RowVectorXd> edge(response.edge.data(), states.cols());
    for (Eigen::Index row = 0; row < count; ++row) out.row(row) += response.motion(result.time[first + row]) * edge;
  }
}

void filter(const Response& response, const Matrix& states, CaseResult& result, Team& team) {
  result.signals.resize(result.time.size() * static_cast<std::size_t>(states.cols()));
  team.run([&](int thread) { filter_share(response, states, result, team, thread); });
}

}  // namespace

void march_exact(const StripProblem& problem, CaseResult& result) {
  const StripCase& strip = problem.strip;
  const Response response = strip.drive ? driven(problem) : released(problem);
  result.time_step = std::min(march_fraction * result.critical_time_step, response.largest_step);
  const double unit = strip.time.step.value_or(strip.time.step_fraction * result.critical_time_step);
  result.sample_interval = unit * static_cast<double>(strip.sample_every);
  const std::size_t values = ReceiverReader(problem.model, problem.stiffness).values();
  const std::uint64_t samples = count_steps(strip, unit, values) / strip.sample_every + 1;
  const double end = static_cast<double>(samples - 1) * result.sample_interval;
  const double work = end / result.time_step * static_cast<double>(samples) * static_cast<double>(values);
  if (!(work <= most_filter_work)) {
    throw CaseError(fmt::format("case \"{}\", time: {:.3g} multiplications for {} exact samples; sample less often, or "
                                "use the integrator verlet",
                                strip.id, work, samples));
  }
  for (std::uint64_t sample = 0; sample < samples; ++sample) {
    result.time.push_back(static_cast<double>(sample) * result.sample_interval);
  }
  const Matrix states = march(problem, response, std::max<std::size_t>(2, states_for(end, result.time_step)), result);
  filter(response, states, result, problem.stiffness.team());
  if (!std::all_of(result.signals.begin(), result.signals.end(), [](double v) { return std::isfinite(v); })) {
    result.status = fmt::format("unstable: step {}", result.steps);
    result.time.clear();
    result.signals.clear();
  }
}

}  // namespace ddem::fem
