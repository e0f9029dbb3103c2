#include "harness/run/fem_reuse.h"

#include <algorithm>
#include <cmath>

namespace ddem::harness {
namespace {

constexpr double kAgreement = 1e-12;

Wave wave_of(const FemCase& c) {
  if (const auto* drive = std::get_if<Drive>(&c.load)) return drive->wave;
  return std::get<InitialPulse>(c.load).wave;
}

double amplitude_of(const FemCase& c) {
  if (const auto* drive = std::get_if<Drive>(&c.load)) return drive->amplitude;
  return std::get<InitialPulse>(c.load).amplitude;
}

double speed_of(const FemCase& c) { return c.material.wave_speed(wave_of(c), c.periodic); }

/// A fraction of the critical step as it is, seconds in units of the passage of the wave.
double step_of(const FemCase& c) {
  if (const auto* seconds = std::get_if<StepSeconds>(&c.step)) return -seconds->seconds * speed_of(c) / c.length;
  return std::get<StepFraction>(c.step).of_critical;
}

/// Between periodic edges the profiles, which depend on x alone, stay plane.
bool plane_wave(const FemCase& c) { return c.periodic && c.integrator == Integrator::exact; }

/// All that the solution depends on, in units of the strip's length and the wave's speed.
std::vector<double> numbers(const FemCase& c) {
  const double length = c.length;
  std::vector<double> n{c.width / length, static_cast<double>(c.elements[0]), static_cast<double>(c.elements[1]),
                        static_cast<double>(c.degree), static_cast<double>(c.periodic), static_cast<double>(c.left),
                        static_cast<double>(c.right), static_cast<double>(c.integrator), step_of(c),
                        static_cast<double>(c.sample_every), plane_wave(c) ? 0.0 : c.material.poisson_ratio,
                        static_cast<double>(c.load.index()), static_cast<double>(wave_of(c)), length};
  if (const auto* drive = std::get_if<Drive>(&c.load)) {
    n.push_back(drive->duration * speed_of(c) / length);
  } else {
    const InitialPulse& p = std::get<InitialPulse>(c.load);
    const double spacing = p.shape == PulseShape::column ? c.column_spacing : 0.0;
    n.insert(n.end(), {static_cast<double>(p.shape), p.width / length, p.center / length, spacing / length});
  }
  for (const auto& [x, y] : c.points) n.insert(n.end(), {x / length, y / length});
  n.push_back(-1.0);  // where points end and sections begin
  for (const double x : c.sections) n.push_back(x / length);
  return n;
}

bool agree(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) {
    return std::abs(x - y) <= kAgreement * std::max(std::abs(x), std::abs(y));
  });
}

void scale(std::vector<std::vector<double>>& signals, double factor, std::size_t samples) {
  for (std::vector<double>& signal : signals) {
    signal.resize(samples);
    for (double& u : signal) u *= factor;
  }
}

}  // namespace

FemReuse share_runs(std::span<const FemCase> cases) {
  FemReuse reuse;
  std::vector<std::vector<double>> problems;
  for (const FemCase& c : cases) {
    const std::vector<double> problem = numbers(c);
    std::size_t run = 0;
    // Fields end with their own case: a case with snapshots is a run of its own.
    const auto serves = [&](const FemCase& other, const std::vector<double>& of) {
      return c.snapshots == 0 && other.snapshots == 0 && other.mesh == c.mesh && agree(problem, of);
    };
    while (run < problems.size() && !serves(reuse.runs[run], problems[run])) ++run;
    if (run == problems.size()) {
      problems.push_back(problem);
      reuse.runs.push_back(c);
    }
    FemCase& first = reuse.runs[run];
    const FemShare share{run, speed_of(first) / speed_of(c), amplitude_of(c) / amplitude_of(first)};
    first.end = std::max(first.end, c.end / share.time);
    reuse.shares.push_back(share);
  }
  return reuse;
}

FemResult rescaled(const FemResult& run, const FemShare& share, const FemCase& c) {
  FemResult r = run;
  r.id = c.id;
  for (double* time : {&r.critical_time_step, &r.time_step, &r.sample_interval}) *time *= share.time;
  for (double& t : r.time) t *= share.time;
  // The first sample that reaches the end is the last, as in a run of its own.
  const auto last = std::find_if(r.time.begin(), r.time.end(), [&](double t) { return t >= c.end * (1.0 - 1e-9); });
  if (last != r.time.end()) r.time.erase(last + 1, r.time.end());
  for (auto* signals : {&r.point_ux, &r.point_uy, &r.section_ux, &r.section_uy}) scale(*signals, share.amplitude, r.time.size());
  return r;
}

}  // namespace ddem::harness
