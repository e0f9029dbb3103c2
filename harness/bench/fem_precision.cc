#include "harness/bench/fem_precision.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/references/dalembert.h"

namespace ddem::harness::bench {
namespace {

constexpr double kLength = 16.5e-3, kWidth = 2e-3, kContinuumPulseWidth = 0.3e-3, kCentre = 3e-3, kContinuumAmplitude = 1e-6;
constexpr double kEnd = 7.5e-6;
constexpr double kMarchFraction = 0.99;  // of the critical step: what ddem-fem marches exact cases with

const char* name_of(Wave wave) { return wave == Wave::shear ? "shear" : "bar"; }

}  // namespace

std::vector<FemMesh> fem_meshes() {
  return {{1, {66, 8}}, {1, {132, 16}}, {1, {264, 32}}, {1, {528, 64}},
          {2, {33, 4}}, {2, {66, 8}},   {2, {132, 16}}, {2, {264, 32}},
          {4, {17, 2}}, {4, {33, 4}},   {4, {50, 6}},   {4, {66, 8}},   {4, {72, 9}}, {4, {99, 12}},
          {8, {8, 1}},  {8, {17, 2}},   {8, {22, 3}},   {8, {25, 3}},   {8, {33, 4}}, {8, {66, 8}}};
}

FemCase pulse_case(const FemMesh& mesh, Wave wave) {
  FemCase c;
  c.length = kLength;
  c.width = kWidth;
  c.degree = mesh.degree;
  c.elements = mesh.elements;
  c.material = {1e10, wave == Wave::shear ? 0.3 : 0.0, 1700.0};
  c.periodic = wave == Wave::shear;
  c.load = InitialPulse{wave, PulseShape::gaussian, kContinuumPulseWidth, kCentre, kContinuumAmplitude};
  c.end = kEnd;
  for (int k = 0; k < 10; ++k) {
    const double x = 1e-3 + 1.3e-3 * k;
    c.points.push_back({x, 0.1 * x});  // heights differ: a plane wave must not care
  }
  return c;
}

double pulse_error(const FemCase& fem, const FemResult& r) {
  const auto& pulse = std::get<InitialPulse>(fem.load);
  const auto end = [](Edge edge) { return edge == Edge::free ? references::End::free : references::End::fixed; };
  // A shear wave does not feel an edge that is held in x.
  const bool shear = pulse.wave == Wave::shear;
  const references::Strip strip{fem.length, fem.material.wave_speed(pulse.wave, fem.periodic), references::End::free,
                                shear ? references::End::free : end(fem.right)};
  const auto& signals = shear ? r.point_uy : r.point_ux;
  const auto profile = [&](double s) { return pulse.amplitude * references::gaussian_profile(s, pulse.center, pulse.width); };
  double residual2 = 0.0, exact2 = 0.0;
  for (std::size_t p = 0; p < fem.points.size(); ++p) {
    for (std::size_t n = 0; n < r.time.size(); ++n) {
      const double exact = references::released_strip(strip, profile, fem.points[p][0], r.time[n]);
      residual2 += std::pow(signals[p][n] - exact, 2);
      exact2 += exact * exact;
    }
  }
  return std::sqrt(residual2 / exact2);
}

std::vector<PrecisionPoint> measure_fem(const std::vector<FemMesh>& meshes, int repetitions, const std::function<void()>& progress) {
  std::vector<FemCase> cases;
  std::vector<PrecisionPoint> points;
  for (const FemMesh& mesh : meshes) {
    for (const Wave wave : {Wave::shear, Wave::longitudinal}) {
      cases.push_back(pulse_case(mesh, wave));
      points.push_back({"FE", fmt::format("p{}, {}", mesh.degree, name_of(wave)), fmt::format("{} x {}", mesh.elements[0], mesh.elements[1]),
                        0, kMarchFraction, 0, HUGE_VAL, 0.0, 0.0, "ok"});
    }
  }
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    const std::vector<FemResult> results = run_fem(cases);
    for (std::size_t k = 0; k < cases.size(); ++k) {
      PrecisionPoint& point = points[k];
      point.seconds = std::min(point.seconds, results[k].solve_seconds);
      if (repetition > 0) continue;
      point.discs_or_dofs = static_cast<std::size_t>(results[k].dofs);
      point.steps = results[k].steps;
      point.status = results[k].status;
      if (point.status == "ok") point.error = point.error_to_continuum = pulse_error(cases[k], results[k]);
    }
    progress();
  }
  return points;
}

}  // namespace ddem::harness::bench
