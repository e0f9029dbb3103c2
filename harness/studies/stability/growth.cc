#include "harness/studies/stability/growth.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dem/spectra/strain_polynomial.h"
#include "harness/measure/linear_prediction.h"
#include "harness/studies/stability/noise_release.h"

namespace ddem::harness {
namespace {

constexpr double kGrowthAmplitude = 1e-9;  // m; every model here is linear
constexpr long kFewestSteps = 15, kSecondLook = 31, kMostSteps = 4000;
constexpr long kNeutralSteps = 300;    // of schemes without memory, which stay in the motion that they are released from
constexpr double kWantedGrowth = 35.0, kWantedDecay = 3.0;  // of ln of the amplitude in a run
constexpr double kEnough = 1e-8;      // residual of the linear prediction, over the signals
constexpr std::size_t kWindow = 60;   // samples
constexpr double kSameReading = 1e-3;  // of the growth, far below the 2 % that count

/// By linear prediction of the last half of recordings of every step, read every `interval` steps.
std::optional<double> growth_read_every(int interval, const std::vector<std::vector<double>>& recordings) {
  const std::size_t steps = recordings.front().size(), samples = (steps - 1) / static_cast<std::size_t>(interval) + 1;
  std::vector<std::vector<double>> read;
  for (const std::vector<double>& every : recordings) {
    std::vector<double>& some = read.emplace_back();
    for (std::size_t k = 0; k < samples; ++k) some.push_back(every[k * static_cast<std::size_t>(interval)]);
  }
  const Prediction p = predict_linearly(read, samples / 2, samples, kEnough);
  if (!(p.largest() > 0.0)) return std::nullopt;
  return std::pow(p.largest(), 1.0 / interval) - 1.0;
}

/// Two motions whose frequencies differ by a multiple of the frequency of reading look like one, of neither's growth. They
/// do so at one interval of three neighbours, not at two: the median of the three, the third where the first two differ.
std::optional<double> growth_a_step(const std::vector<std::vector<double>>& recordings, int interval) {
  if (interval <= 1) return growth_read_every(1, recordings);
  auto first = growth_read_every(interval, recordings), second = growth_read_every(interval - 1, recordings);
  if (!first || !second) return first ? first : second;
  if (std::abs(*first - *second) <= kSameReading * std::max(std::abs(*first), kGrowthFloor)) return first;
  const auto third = growth_read_every(interval + 1, recordings);
  if (!third) return first;
  std::array<double, 3> readings{*first, *second, *third};
  std::sort(readings.begin(), readings.end());
  return readings[1];
}

}  // namespace

SimulationInput input_of(const Subject& subject, const DeformationParameters& d) {
  SimulationInput in;
  in.contact = subject.contact();
  in.deformation = d;
  in.energy_samples = 0;
  if (d.scheme == Scheme::implicit) in.relaxations = strain_relaxations(subject.assembly(), subject.contact(), d);
  return in;
}

std::optional<double> release(const Solver& solver, const Subject& subject, const Start& start, SimulationInput in) {
  const ddem::Assembly& a = subject.assembly();
  const double r = mean_radius(a.packing);
  // v_0 lies halfway between the half steps: (1 - 1/z + z - 1) q_0 / (2 dt).
  const Complex z = start.factor, rate = 0.5 * (z - 1.0 / z) / in.time_step;
  const auto set = [&](const std::vector<Complex>& q, double unit, std::vector<double>& u, std::vector<double>& v) {
    for (const Complex& value : q) u.push_back(unit * value.real()), v.push_back(unit * (rate * value).real());
  };
  set(start.ux, kGrowthAmplitude, in.initial.ux, in.initial.vx);
  set(start.uy, kGrowthAmplitude, in.initial.uy, in.initial.vy);
  set(start.theta, kGrowthAmplitude / r, in.initial.theta, in.initial.omega);
  const bool lagged = in.deformation.scheme == Scheme::lagged;
  const double growth = std::log(std::abs(z)), wanted = growth > 0.0 ? kWantedGrowth : kWantedDecay;
  in.steps = std::clamp(static_cast<long>(std::min(wanted / std::max(std::abs(growth), 1e-12), 1e9)), kFewestSteps, lagged ? kMostSteps : kNeutralSteps);
  if (in.steps > kFewestSteps) in.steps = std::max(in.steps, kSecondLook);
  // A run counts as diverged at 1e3 = e^6.9 times its start, which is looked at every 16 steps and at the end: too soon to be
  // rid of the motions that grow a little slower. So all discs are displaced alike besides, which moves no overlap, by as much
  // as allows the growth; its round-off grows like the rest.
  const double grown = growth * static_cast<double>((in.steps - 1) / 16 * 16);
  const double offset = kGrowthAmplitude * std::exp(grown - 6.0) * (grown > 6.0 ? 1.0 : 0.0);
  for (double& u : in.initial.ux) u += offset;
  for (int p = 0; p < static_cast<int>(a.size()); ++p) in.receivers.push_back({{p}});
  const Signals signals = solver.solve(a, in).signals;
  std::vector<std::vector<double>> all = signals.ux;
  for (std::vector<double>& u : all) {
    for (double& value : u) value -= offset;
  }
  all.insert(all.end(), signals.uy.begin(), signals.uy.end());
  for (std::vector<double> theta : signals.theta) {
    for (double& value : theta) value *= r;
    all.push_back(std::move(theta));
  }
  return growth_a_step(all, static_cast<int>(in.steps / 2 / static_cast<long>(kWindow)));
}

bool noise_grows(const Solver& solver, const Subject& subject, SimulationInput in) {
  in.steps = kNoiseSteps;
  in.initial.ux = steady_noise(subject.assembly().size(), 1, kGrowthAmplitude);
  in.initial.uy = steady_noise(subject.assembly().size(), 2, kGrowthAmplitude);
  return solver.solve(subject.assembly(), in).breakdown.has_value();
}

}  // namespace ddem::harness
