#include "dem/simulation/exact.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <span>
#include <stdexcept>
#include <utility>

#include "dem/core/time_filter.h"
#include "dem/spectra/strain_polynomial.h"

namespace ddem {
namespace {

// At the very critical step the fastest mode would grow linearly; Lanczos finds that step to 5e-4 or better.
constexpr double kMarchFraction = 0.99;

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// sum_k a_k(t) T_k start, with the receivers' values of T_k start in the rows of `states`.
struct Response {
  InitialState start;  // displacements alone
  std::function<void(std::span<const double> times, double time_step, std::span<double> a)> coefficients;
  bool is_motion;  // its march passes through the motion itself, if only to second order in time
  Matrix states = {};
};

bool any(const std::vector<double>& v) {
  return std::any_of(v.begin(), v.end(), [](double x) { return x != 0.0; });
}
bool any(const InitialState& displaced) {
  return any(displaced.ux) || any(displaced.uy) || any(displaced.theta);
}

void check(const Assembly& a, const SimulationInput& in, const Sampling& sampling) {
  check_input(a, in);
  const DeformationParameters& d = in.deformation;
  if (in.contact.kinematics != Kinematics::linear)
    throw std::invalid_argument("exact in time needs linear kinematics");
  if (d.scheme == Scheme::lagged)
    throw std::invalid_argument(
        "exact in time needs rigid discs or implicit strains: of the lagged scheme the step is a part");
  if (d.active() && d.solver != StrainSolver::polynomial)
    throw std::invalid_argument("exact in time needs the polynomial's implicit strains");
  if (d.active() && d.correction == Correction::normal && in.contact.has_rotation()) {
    throw std::invalid_argument("exact in time needs strains that derive from an energy");
  }
  if (!(sampling.interval > 0.0) || sampling.samples < 1)
    throw std::invalid_argument("exact signals need samples at a positive interval");
}

/// What the driven discs do is prescribed: in the driven direction they are held, and start from zero.
void give_way_to_drive(SimulationInput& in, std::size_t discs) {
  if (!in.drive) return;
  const bool x = in.drive->direction == Direction::x;
  std::vector<std::uint8_t>& held = x ? in.held.x : in.held.y;
  held.resize(discs, 0);
  for (const int d : in.drive->discs) {
    held[d] = 1;
    for (auto* start :
         x ? std::array{&in.initial.ux, &in.initial.vx} : std::array{&in.initial.uy, &in.initial.vy}) {
      if (!start->empty()) (*start)[d] = 0.0;
    }
  }
}

/// A march from rest; the signals of all its steps.
SimulationInput march_input(const SimulationInput& in, const InitialState& start, long steps) {
  SimulationInput m = in;
  m.initial = {start.ux, start.uy, start.theta, {}, {}, {}};
  m.drive.reset();
  m.steps = steps;
  m.sample_every = 1;
  m.energy_samples = std::min(in.energy_samples, 1);
  m.snapshots = 0;
  return m;
}

/// At rest the prescribed edge e g(t) accelerates the free discs by -M^-1 K e g(t). A leapfrog's first
/// velocity is half a step of that; e in m, thus m/s^2.
InitialState acceleration_by_edge(const Assembly& a, const SimulationInput& in) {
  InitialState edge;
  auto& moved = in.drive->direction == Direction::x ? edge.ux : edge.uy;
  moved.assign(a.size(), 0.0);
  for (const int d : in.drive->discs) moved[d] = in.drive->amplitude;
  SimulationInput step = march_input(in, edge, 1);
  step.receivers.clear();
  step.new_contacts = ContactWatch::off;
  step.on_progress = nullptr;
  const InitialState after = simulate(a, step).final_state;
  InitialState acceleration{after.vx, after.vy, after.omega, {}, {}, {}};
  for (auto* v : {&acceleration.ux, &acceleration.uy, &acceleration.theta}) {
    for (double& x : *v) x *= 2.0 / in.time_step;
  }
  return acceleration;
}

std::vector<Response> responses(const Assembly& a, const SimulationInput& in) {
  std::vector<Response> all;
  const InitialState velocity{in.initial.vx, in.initial.vy, in.initial.omega, {}, {}, {}};
  const bool struck = any(velocity);
  if (in.drive) {
    const Sin2 pulse{in.drive->duration};
    all.push_back({acceleration_by_edge(a, in),
                   [pulse](std::span<const double> t, double dt, std::span<double> c) { drive_coefficients(pulse, t, dt, c); },
                   false});
  }
  if (struck) all.push_back({velocity, impulse_coefficients, false});
  if (any(in.initial) || all.empty()) all.push_back({in.initial, release_coefficients, all.empty()});
  return all;
}

/// Receivers' values of a sample: u_x, u_y, and theta where there are rotations, receiver by receiver.
Eigen::Index values_per_receiver(const SimulationInput& in) {
  return in.contact.has_rotation() ? 3 : 2;
}

Matrix as_matrix(const Signals& s, Eigen::Index values) {
  const auto receivers = static_cast<Eigen::Index>(s.ux.size()),
             rows = static_cast<Eigen::Index>(s.time.size());
  Matrix m(rows, values * receivers);
  for (Eigen::Index r = 0; r < receivers; ++r) {
    for (Eigen::Index c = 0; c < values; ++c) {
      const std::vector<double>& column = (c == 0   ? s.ux
                                           : c == 1 ? s.uy
                                                    : s.theta)[static_cast<std::size_t>(r)];
      m.col(values * r + c) = Eigen::Map<const Eigen::VectorXd>(column.data(), rows);
    }
  }
  return m;
}

/// Adds the response to the samples, in blocks that are products of matrices.
void filter(const Response& response, double time_step, const Sampling& sampling, Matrix& samples) {
  constexpr Eigen::Index block = 32;
  Eigen::MatrixXd coefficients(block, response.states.rows());
  std::vector<double> times;
  for (Eigen::Index first = 0; first < samples.rows(); first += block) {
    const Eigen::Index count = std::min(block, samples.rows() - first);
    times.clear();
    for (Eigen::Index row = 0; row < count; ++row) times.push_back(sampling.interval * static_cast<double>(first + row));
    // Later states do not reach back to these samples.
    const Eigen::Index reach =
        std::min(response.states.rows(), static_cast<Eigen::Index>(states_for(times.back(), time_step)));
    response.coefficients(times, time_step, {coefficients.data(), static_cast<std::size_t>(count * reach)});
    samples.middleRows(first, count).noalias() +=
        Eigen::Map<const Eigen::MatrixXd>(coefficients.data(), count, reach) * response.states.topRows(reach);
  }
}

/// The driven edge itself, as the receivers see it.
void add_edge(const SimulationInput& in, const Sampling& sampling, Matrix& samples) {
  if (!in.drive) return;
  const Eigen::Index values = values_per_receiver(in),
                     component = in.drive->direction == Direction::x ? 0 : 1;
  for (std::size_t r = 0; r < in.receivers.size(); ++r) {
    const std::vector<int>& discs = in.receivers[r].discs;
    const auto driven = [&in](int d) {
      return std::find(in.drive->discs.begin(), in.drive->discs.end(), d) != in.drive->discs.end();
    };
    const double share = static_cast<double>(std::count_if(discs.begin(), discs.end(), driven)) /
                         static_cast<double>(discs.size());
    if (share == 0.0) continue;
    for (Eigen::Index row = 0; row < samples.rows(); ++row) {
      samples(row, values * static_cast<Eigen::Index>(r) + component) +=
          share * in.drive->displacement(sampling.interval * static_cast<double>(row));
    }
  }
}

Signals as_signals(const Matrix& samples, const Sampling& sampling, Eigen::Index values) {
  Signals s;
  for (Eigen::Index row = 0; row < samples.rows(); ++row)
    s.time.push_back(sampling.interval * static_cast<double>(row));
  const auto column = [&samples](Eigen::Index c) {
    std::vector<double> v(static_cast<std::size_t>(samples.rows()), 0.0);
    Eigen::Map<Eigen::VectorXd>(v.data(), samples.rows()) = samples.col(c);
    return v;
  };
  for (Eigen::Index c = 0; c < samples.cols(); c += values) {
    s.ux.push_back(column(c));
    s.uy.push_back(column(c + 1));
    s.theta.push_back(values == 3 ? column(c + 2) : std::vector<double>(s.time.size(), 0.0));
  }
  return s;
}

/// The marches of a run, with one bar of progress; what they amount to.
class Marches {
 public:
  Marches(const Assembly& a, const SimulationInput& in, std::size_t count)
      : assembly_(a), progress_(in.on_progress), count_(count) {}

  /// Whether the run may go on.
  bool run(SimulationInput input) {
    if (progress_) {
      input.on_progress = [this](double fraction) {
        return progress_((static_cast<double>(done_) + fraction) / static_cast<double>(count_));
      };
    }
    last_ = simulate(assembly_, input);
    ++done_;
    total.wall_seconds += last_.wall_seconds;
    total.steps_done += last_.steps_done;
    total.breakdown = last_.breakdown;
    total.stopped = last_.stopped;
    total.new_contacts = last_.new_contacts;
    if (last_.energy_drift)
      total.energy_drift = std::max(total.energy_drift.value_or(0.0), *last_.energy_drift);
    return !total.breakdown && !total.stopped && !total.new_contacts;
  }
  const Signals& signals() const { return last_.signals; }

  SimulationResult total;

 private:
  const Assembly& assembly_;
  const std::function<bool(double)>& progress_;
  std::size_t count_, done_ = 0;
  SimulationResult last_;
};

}  // namespace

double exact_step(double critical, const std::optional<EdgeDrive>& drive) {
  const double step = kMarchFraction * critical;
  return drive ? std::min(step, largest_step_for(Sin2{drive->duration})) : step;
}

double filter_work(const SimulationInput& in, const Sampling& sampling) {
  return 0.5 * sampling.end() / in.time_step * static_cast<double>(sampling.samples) *
         static_cast<double>(in.receivers.size()) * static_cast<double>(values_per_receiver(in));
}

SimulationResult simulate_exact(const Assembly& assembly, const SimulationInput& given,
                                const Sampling& sampling) {
  check(assembly, given, sampling);
  SimulationInput in = given;
  if (in.deformation.active() && in.relaxations.empty()) {
    in.relaxations = strain_relaxations(assembly, in.contact, in.deformation);  // once for all marches
  }
  give_way_to_drive(in, assembly.size());
  std::vector<Response> parts = responses(assembly, in);
  const bool watched_apart =
      in.new_contacts != ContactWatch::off && !(parts.size() == 1 && parts.front().is_motion);
  Marches marches(assembly, in, parts.size() + (watched_apart ? 1 : 0));
  const auto seconds_since = [](std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };

  const long last = static_cast<long>(std::max<std::size_t>(2, states_for(sampling.end(), in.time_step))) - 1;
  if (watched_apart) {
    SimulationInput motion = in;
    motion.steps = std::max<long>(1, static_cast<long>(std::ceil(sampling.end() / in.time_step)));
    motion.receivers.clear();
    motion.energy_samples = 0;
    motion.snapshots = 0;
    if (!marches.run(std::move(motion))) return std::move(marches.total);
    in.new_contacts = ContactWatch::off;
  }
  Matrix samples = Matrix::Zero(static_cast<Eigen::Index>(sampling.samples),
                                values_per_receiver(in) * static_cast<Eigen::Index>(in.receivers.size()));
  for (Response& part : parts) {
    if (!marches.run(march_input(in, part.start, last))) return std::move(marches.total);
    const auto start = std::chrono::steady_clock::now();
    part.states = as_matrix(marches.signals(), values_per_receiver(in));
    filter(part, in.time_step, sampling, samples);
    marches.total.wall_seconds += seconds_since(start);
  }
  add_edge(in, sampling, samples);
  marches.total.signals = as_signals(samples, sampling, values_per_receiver(in));
  return std::move(marches.total);
}

}  // namespace ddem
