// The time loop against exact plane waves: how a wave grows or decays in a step, and the order in dt of each scheme.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <complex>
#include <numbers>

#include "dem/simulation/simulation.h"
#include "dem/spectra/bloch.h"
#include "dem/spectra/dense_eigen.h"
#include "dem/spectra/spectra.h"
#include "tests/support/assemblies.h"

namespace ddem {
namespace {

using test::kNormalStiffness;

constexpr int kColumns = 16;
constexpr double kRadius = 1e-4, kAmplitude = 1e-9;
constexpr double kWaveNumber = std::numbers::pi / (kColumns * kRadius);  // one wave over the lattice, along its rows

Assembly lattice() {
  return test::hexagonal_assembly({.columns = kColumns, .rows = 4, .radius = kRadius, .periodic_x = true, .periodic_y = true});
}

HexagonalBloch bloch_of(const SimulationInput& in) {
  return {{kRadius, test::kDensity, 1.0, 0.0}, in.contact, in.deformation};
}

/// A standing shear wave, from rest: u_y = A cos(k x). Its receiver sits on a crest.
SimulationInput shear_wave(const Assembly& a, double lambda, const DeformationParameters& d, double step_fraction) {
  SimulationInput in;
  in.contact = {kNormalStiffness, lambda, Kinematics::linear};
  in.deformation = d;
  in.time_step = step_fraction * 2.0 / largest_frequency(a, in.contact, {});
  for (const double x : a.packing.x) in.initial.uy.push_back(kAmplitude * std::cos(kWaveNumber * (x - a.packing.x[0])));
  in.receivers = {{{0}}};
  return in;
}

DeformationParameters strains(Scheme scheme, Correction correction = Correction::full) {
  return {scheme, correction, 4.0 * kNormalStiffness, 0.3, Plane::stress};
}

/// Linear prediction: u_n = sum of c_j z_j^n, j = 1..order, obeys u_n = a_1 u_{n-1} + ... + a_order u_{n-order}, and the
/// z_j are the roots of z^order - a_1 z^(order-1) - ... Exact for signals without noise.
std::vector<std::complex<double>> multipliers_of(const std::vector<double>& u, int order, std::size_t first) {
  const Eigen::Index rows = static_cast<Eigen::Index>(u.size() - first) - order;
  Eigen::MatrixXd past(rows, order);
  Eigen::VectorXd now(rows);
  for (Eigen::Index n = 0; n < rows; ++n) {
    for (int j = 0; j < order; ++j) past(n, j) = u[first + n + j];
    now[n] = u[first + n + order];
  }
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(order, order);
  companion.topRightCorner(order - 1, order - 1).setIdentity();
  companion.row(order - 1) = least_squares(past, now).transpose();
  const Eigen::VectorXcd roots = eigenvalues(companion, "linear prediction");
  return {roots.begin(), roots.end()};
}

struct Lag {
  std::string name;
  double lambda;
  int evaluations;
  double relaxation;
  Correction correction;
};

class LagDamping : public testing::TestWithParam<Lag> {};
INSTANTIATE_TEST_SUITE_P(Lags, LagDamping,
                         testing::Values(Lag{"published_frictionless", 0.0, 1, 1.0, Correction::normal},
                                         Lag{"published", 0.25, 1, 1.0, Correction::normal},
                                         Lag{"one_evaluation", 0.5, 1, 1.0, Correction::full},
                                         Lag{"two_evaluations_grow", 0.5, 2, 1.0, Correction::full},
                                         Lag{"three_evaluations", 0.5, 3, 1.0, Correction::full},
                                         Lag{"relaxed", 0.5, 1, 0.5, Correction::full},
                                         Lag{"normal_only_stress", 0.5, 1, 1.0, Correction::normal_only_stress}),
                         [](const auto& tested) { return tested.param.name; });

TEST_P(LagDamping, OfASimulationIsThatOfTheBlochMultiplier) {
  const Lag& lag = GetParam();
  const Assembly a = lattice();
  DeformationParameters d = strains(Scheme::lagged, lag.correction);
  d.evaluations = lag.evaluations;
  d.relaxation = lag.relaxation;
  SimulationInput in = shear_wave(a, lag.lambda, d, 0.2);
  // Every 8th step: samples far enough apart that the recurrence is well conditioned.
  in.sample_every = 8;
  in.steps = 8000;
  const std::vector<double> u = simulate(a, in).signals.uy[0];

  const HexagonalBloch bloch = bloch_of(in);
  const WaveVector k{kWaveNumber, 0.0};
  const double omega = bloch.frequencies(k)[0].real();
  const std::complex<double> exact = bloch.multiplier_of(k, in.time_step, omega);
  // By symmetry only shear and rotation take part: one pair of factors each. The strains' own factors are below 0.6 a
  // step (|1 - w - w b|), gone to 1e-17 after 80 steps.
  const int order = lag.lambda == 0.0 ? 2 : 4;
  const auto measured = multipliers_of(u, order, 10);
  const std::complex<double> expected = std::pow(exact, 8);
  const auto z = *std::min_element(measured.begin(), measured.end(), [&](const auto& x, const auto& y) {
    return std::abs(x - expected) < std::abs(y - expected);
  });
  const double growth = std::pow(std::abs(z), 1.0 / 8) - 1.0, predicted = std::abs(exact) - 1.0;
  EXPECT_EQ(predicted > 0.0, lag.evaluations == 2);
  EXPECT_GT(std::abs(predicted), 3e-5);
  // Linear prediction has the round-off of the signal, 1e-16 of its start, times the conditioning of its columns, some
  // 1e4, over the growth of at least 3e-5: 3e-8.
  EXPECT_NEAR(growth / predicted, 1.0, 1e-7) << growth;
}

/// Largest |u(t) - A cos(omega t)| / A over two periods.
double displacement_error(const DeformationParameters& d, double step_fraction) {
  const Assembly a = lattice();
  SimulationInput in = shear_wave(a, 0.0, d, step_fraction);
  const double omega = bloch_of(in).frequencies({kWaveNumber, 0.0})[0].real();
  in.steps = std::lround(4.0 * std::numbers::pi / (omega * in.time_step));
  const Signals s = simulate(a, in).signals;
  double error = 0.0;
  for (std::size_t n = 0; n < s.time.size(); ++n) {
    error = std::max(error, std::abs(s.uy[0][n] / kAmplitude - std::cos(omega * s.time[n])));
  }
  return error;
}

/// Orders of three runs, each with half the step of the one before: the error is C dt^p (1 + O(dt)).
void expect_order(const std::function<double(double)>& error, double order, double tolerance) {
  const double coarse = error(0.2), middle = error(0.1), fine = error(0.05);
  EXPECT_NEAR(std::log2(coarse / middle), order, 2.0 * tolerance);
  EXPECT_NEAR(std::log2(middle / fine), order, tolerance);
}

TEST(ObservedOrder, DemIsOfSecondOrder) {
  // The phase error is t omega (omega dt)^2/24 and the next term smaller by (omega dt)^2, below 1e-3; the crest of the
  // error falls between two samples at worst, 1 - cos(omega dt / 2) below 1e-3 of it.
  expect_order([](double fraction) { return displacement_error({}, fraction); }, 2.0, 5e-3);
}

TEST(ObservedOrder, ImplicitStrainsAreOfSecondOrder) {
  DeformationParameters d = strains(Scheme::implicit);
  d.tolerance = 1e-12;  // the time step's error alone remains, 1e-6 at the finest
  expect_order([&](double fraction) { return displacement_error(d, fraction); }, 2.0, 5e-3);
}

TEST(ObservedOrder, LaggedStrainsAreOfFirstOrder) {
  // The next term is of relative size omega dt and (omega tau) pi, together 0.1 at the coarsest step: log2 of
  // (1 + 0.1)/(1 + 0.05) is 0.07.
  expect_order([](double fraction) { return displacement_error(strains(Scheme::lagged), fraction); }, 1.0, 0.07);
}

/// Share of its energy that the wave loses in two periods, from the factors of the simulation: 1 - |z|^(2 n).
double energy_loss(double step_fraction) {
  const Assembly a = lattice();
  SimulationInput in = shear_wave(a, 0.0, strains(Scheme::lagged), step_fraction);
  const double omega = bloch_of(in).frequencies({kWaveNumber, 0.0})[0].real();
  in.sample_every = std::lround(1.6 / step_fraction);
  in.steps = std::lround(8.0 * std::numbers::pi / (omega * in.time_step));
  const auto z = multipliers_of(simulate(a, in).signals.uy[0], 2, static_cast<std::size_t>(80 / in.sample_every));
  const double samples_in_two_periods = 4.0 * std::numbers::pi / (omega * in.time_step * static_cast<double>(in.sample_every));
  return 1.0 - std::pow(std::abs(z[0]), 2.0 * samples_in_two_periods);
}

TEST(ObservedOrder, EnergyLossOfLaggedStrainsIsOfFirstOrder) {
  // 1 - exp(-x) = x (1 - x/2): x is 0.2 at the coarsest step, which bends the order by log2(0.9/0.95) = 0.08.
  expect_order(energy_loss, 1.0, 0.08);
  EXPECT_GT(energy_loss(0.2), 1e-2);
}

TEST(ObservedOrder, ImplicitStrainsLoseNoEnergy) {
  const Assembly a = lattice();
  SimulationInput in = shear_wave(a, 0.5, strains(Scheme::implicit), 0.9);
  in.steps = 10000;
  EXPECT_LT(simulate(a, in).energy_drift.value(), 1e-12);
}

}  // namespace
}  // namespace ddem
