#include "harness/campaign/stability_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <set>

#include "dem/assembly/contacts.h"
#include "dem/spectra/bloch.h"
#include "dem/spectra/spectra.h"
#include "dem/spectra/step_map.h"
#include "dem/spectra/strain_polynomial.h"
#include "harness/measure/linear_prediction.h"
#include "meshes/packings/hexagonal.h"
#include "meshes/packings/random.h"

namespace ddem::harness {
namespace {

using Complex = std::complex<double>;

constexpr double kAmplitude = 1e-9;  // m; every model here is linear
constexpr int kCells = 6;            // of the lattice along each side: holds the corners and edge centres of the zone
constexpr double kRadius = 1e-4;     // m; nothing depends on it
constexpr long kFewestSteps = 15, kSecondLook = 31, kMostSteps = 4000, kNoiseSteps = 400;
constexpr long kNeutralSteps = 300;    // of schemes without memory, which stay in the motion that they are released from
constexpr double kWantedGrowth = 35.0, kWantedDecay = 3.0;  // of ln of the amplitude in a run
constexpr double kNoGrowth = 1e-9;
// Strains that move no disc grow from round-off, 1e-16 of the start and less, and are seen before a motion of growth g has
// grown by e^35 if they grow faster than 2 g.
constexpr double kDrowned = 1.5;
constexpr double kEnough = 1e-8;      // residual of the linear prediction, over the signals
constexpr std::size_t kWindow = 60;   // samples
constexpr double kSameReading = 1e-3;  // of the growth, far below the 2 % that count
// Noise of displacements holds a share of 1/sqrt(2 discs) of the worst motion, 0.1, or a hundredth of that where rotations and
// strains are most of it, and diverges at 1e3: 1e6 = e^13.8.
constexpr double kNoiseGrowth = 14.0 / kNoiseSteps;

const char* slug(Correction c) { return c == Correction::normal ? "normal" : c == Correction::full ? "full" : "normal-only-stress"; }
const char* symbol(Correction c) { return c == Correction::normal ? "N" : c == Correction::full ? "F" : "NN"; }

/// A motion to start from, q_0 and its factor.
struct Start {
  Complex factor;
  std::vector<Complex> ux, uy, theta;  ///< a disc each; theta in rad times the mean radius
  double motionless = 0.0;             ///< ln of the largest factor beyond 1 of strains that move no disc
};

/// Those of the periodic piece, one of all that the lattice's rotations and mirrors take into each other: they have the same
/// factors.
std::vector<WaveVector> waves_of_the_cell() {
  std::vector<WaveVector> waves;
  std::set<std::array<int, 3>> seen;
  const double unit = 2.0 * std::numbers::pi / (kCells * kRadius);
  for (int i = 0; i <= kCells / 2; ++i) {
    for (int j = 0; j < kCells; ++j) {
      // Phases along three bonds 120 degrees apart, in units of pi/kCells: the symmetries permute them, or turn all signs.
      const auto sorted = [](std::array<int, 3> phases) {
        for (int& phase : phases) phase = (phase % (2 * kCells) + 2 * kCells) % (2 * kCells);
        std::sort(phases.begin(), phases.end());
        return phases;
      };
      const int a = 2 * i, b = 2 * j - i, c = -i - 2 * j;
      if (seen.insert(std::min(sorted({a, b, c}), sorted({-a, -b, -c}))).second) waves.push_back({0.5 * unit * i, unit * j / std::numbers::sqrt3});
    }
  }
  return waves;
}

/// The assembly of a map with its predictions.
class Subject {
 public:
  Subject(ddem::Assembly assembly, bool lattice, const ContactParameters& contact) : a_(std::move(assembly)), lattice_(lattice), contact_(contact) {
    critical_ = 2.0 / largest_frequency(a_, contact_, {});
    if (lattice_) waves_ = waves_of_the_cell();
  }
  const ddem::Assembly& assembly() const { return a_; }
  const ContactParameters& contact() const { return contact_; }
  double critical_step() const { return critical_; }

  Start worst(const DeformationParameters& d, double dt) const { return lattice_ ? worst_wave(d, dt) : worst_mode(d, dt); }
  /// The largest at which no motion grows, s; 0: none.
  double largest_step(const DeformationParameters& d) const;

 private:
  HexagonalBloch bloch(const DeformationParameters& d) const { return {{kRadius, a_.density, a_.thickness, 0.0}, contact_, d}; }
  Start worst_wave(const DeformationParameters& d, double dt) const;
  Start worst_mode(const DeformationParameters& d, double dt) const;

  ddem::Assembly a_;
  bool lattice_;
  ContactParameters contact_;
  double critical_ = 0.0;
  std::vector<WaveVector> waves_;
};

/// Growing, decaying, or neither: motions that strain no disc, which some wave vectors have, keep their energy in every
/// scheme, and say nothing of it.
int kind(const Complex& z) {
  const double growth = std::abs(z) - 1.0;
  return growth > kNoGrowth ? 2 : growth < -kNoGrowth ? 1 : 0;
}

/// Of the neutral ones, the fastest.
bool leads(const Complex& z, const Complex& best) {
  if (kind(z) != kind(best)) return kind(z) > kind(best);
  return kind(z) > 0 ? std::abs(z) > std::abs(best) : std::abs(std::arg(z)) > std::abs(std::arg(best));
}

Start Subject::worst_wave(const DeformationParameters& d, double dt) const {
  const HexagonalBloch waves = bloch(d);
  WaveMode worst{0.0, {}};
  WaveVector at;
  double motionless = 0.0;
  for (const WaveVector& k : waves_) {
    // Motions, which take most of the time, only where a factor may count.
    const std::vector<Complex> factors = waves.multipliers(k, dt);
    const bool counts = std::any_of(factors.begin(), factors.end(), [&](const Complex& z) {
      return std::abs(z) > 1.0 || (std::abs(z - 1.0) >= kTranslationFactor && (worst.motion.size() == 0 || leads(z, worst.factor)));
    });
    if (!counts) continue;
    for (const WaveMode& m : waves.modes(k, dt)) {
      if (!(m.motion.norm() > 0.0)) motionless = std::max(motionless, std::log(std::abs(m.factor)));
      if (!(m.motion.norm() > 0.0) || std::abs(m.factor - 1.0) < kTranslationFactor) continue;
      if (worst.motion.size() == 0 || leads(m.factor, worst.factor)) worst = m, at = k;
    }
  }
  Start start{worst.factor, {}, {}, {}, motionless};
  for (std::size_t p = 0; p < a_.size(); ++p) {
    const Complex phase = std::polar(1.0, at.x * a_.packing.x[p] + at.y * a_.packing.y[p]);
    start.ux.push_back(phase * worst.motion[0]);
    start.uy.push_back(phase * worst.motion[1]);
    if (worst.motion.size() == 3) start.theta.push_back(phase * worst.motion[2]);
  }
  return start;
}

Start Subject::worst_mode(const DeformationParameters& d, double dt) const {
  const StepMode mode = leading_mode(a_, contact_, d, dt);
  Start start{mode.factor, {}, {}, {}, 0.0};
  const int dofs = contact_.has_rotation() ? 3 : 2;
  for (Eigen::Index p = 0; p < static_cast<Eigen::Index>(a_.size()); ++p) {
    start.ux.push_back(mode.motion[dofs * p]);
    start.uy.push_back(mode.motion[dofs * p + 1]);
    if (dofs == 3) start.theta.push_back(mode.motion[dofs * p + 2]);
  }
  return start;
}

/// By bisection over the waves of the piece, or the limits of spectra.h.
double Subject::largest_step(const DeformationParameters& d) const {
  if (!lattice_) {
    return ddem::critical_step(a_, contact_, d, {}).step.value_or(0.0);
  }
  const HexagonalBloch waves = bloch(d);
  const auto stays = [](const Complex& z) { return std::abs(z) < 1.0 + kNoGrowth || std::abs(z - 1.0) < kTranslationFactor; };
  const auto stable = [&](double dt) {
    return std::all_of(waves_.begin(), waves_.end(), [&](const WaveVector& k) {
      const std::vector<Complex> factors = waves.multipliers(k, dt);
      return std::all_of(factors.begin(), factors.end(), stays);
    });
  };
  double low = 0.005 * critical_, high = 1.5 * critical_;
  if (!stable(low)) return 0.0;
  if (stable(high)) return high;
  while (high - low > 2e-3 * critical_) {
    const double middle = 0.5 * (low + high);
    (stable(middle) ? low : high) = middle;
  }
  return low;
}

Subject subject_of(const StripCampaign& s, const StabilityGrid& grid, const StabilityKey& key) {
  ContactParameters contact;
  contact.normal_stiffness = s.normal_stiffness;
  contact.stiffness_ratio = key.stiffness_ratio;
  if (key.packing == StripPacking::hexagonal) {
    const Packing p = packings::hexagonal({.columns = kCells, .rows = kCells, .radius = kRadius, .periodic_x = true, .periodic_y = true});
    return {make_assembly(p, bonds_within_gap(p, 0.1 * kRadius), 1.0, s.density), true, contact};
  }
  // Square, of mean radius near kRadius: the discs fill 0.85 of it.
  const double side = std::sqrt(grid.random_discs * std::numbers::pi / 0.85) * kRadius;
  const Packing p = packings::random_jammed({.length = side, .width = side, .discs = grid.random_discs, .seed = static_cast<std::uint64_t>(s.seeds.front())});
  return {make_assembly(p, bonds_within_gap(p, 0.3 * mean_radius(p)), 1.0, s.density, RattlerRule::peel), false, contact};
}

/// All but the time step and the start.
SimulationInput input_of(const Subject& subject, const DeformationParameters& d) {
  SimulationInput in;
  in.contact = subject.contact();
  in.deformation = d;
  in.energy_samples = 0;
  if (d.scheme == Scheme::implicit) in.relaxations = strain_relaxations(subject.assembly(), subject.contact(), d);
  return in;
}

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

/// Released from the predicted motion, its growth a step.
std::optional<double> release(const Subject& subject, const Start& start, SimulationInput in) {
  const ddem::Assembly& a = subject.assembly();
  const double r = mean_radius(a.packing);
  // v_0 lies halfway between the half steps: (1 - 1/z + z - 1) q_0 / (2 dt).
  const Complex z = start.factor, rate = 0.5 * (z - 1.0 / z) / in.time_step;
  const auto set = [&](const std::vector<Complex>& q, double unit, std::vector<double>& u, std::vector<double>& v) {
    for (const Complex& value : q) u.push_back(unit * value.real()), v.push_back(unit * (rate * value).real());
  };
  set(start.ux, kAmplitude, in.initial.ux, in.initial.vx);
  set(start.uy, kAmplitude, in.initial.uy, in.initial.vy);
  set(start.theta, kAmplitude / r, in.initial.theta, in.initial.omega);
  const bool lagged = in.deformation.scheme == Scheme::lagged;
  const double growth = std::log(std::abs(z)), wanted = growth > 0.0 ? kWantedGrowth : kWantedDecay;
  in.steps = std::clamp(static_cast<long>(std::min(wanted / std::max(std::abs(growth), 1e-12), 1e9)), kFewestSteps, lagged ? kMostSteps : kNeutralSteps);
  if (in.steps > kFewestSteps) in.steps = std::max(in.steps, kSecondLook);
  // A run counts as diverged at 1e3 = e^6.9 times its start, which is looked at every 16 steps and at the end: too soon to be
  // rid of the motions that grow a little slower. So all discs are displaced alike besides, which moves no overlap, by as much
  // as allows the growth; its round-off grows like the rest.
  const double grown = growth * static_cast<double>((in.steps - 1) / 16 * 16);
  const double offset = kAmplitude * std::exp(grown - 6.0) * (grown > 6.0 ? 1.0 : 0.0);
  for (double& u : in.initial.ux) u += offset;
  for (int p = 0; p < static_cast<int>(a.size()); ++p) in.receivers.push_back({{p}});
  const Signals signals = simulate(a, in).signals;
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

/// Noise that is the same everywhere: no library's random numbers, whose distributions differ.
std::vector<double> noise(std::size_t n, std::uint64_t state) {
  std::vector<double> values(n);
  for (double& v : values) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    v = kAmplitude * (static_cast<double>(state >> 11) * 0x1.0p-52 - 1.0);
  }
  return values;
}

bool noise_grows(const Subject& subject, SimulationInput in) {
  in.steps = kNoiseSteps;
  in.initial.ux = noise(subject.assembly().size(), 1);
  in.initial.uy = noise(subject.assembly().size(), 2);
  return simulate(subject.assembly(), in).breakdown.has_value();
}

DeformationParameters strains(const StripCampaign& s, const StabilityKey& key, double softness) {
  DeformationParameters d;
  if (key.scheme == Scheme::none) return d;
  d.scheme = key.scheme;
  d.correction = key.correction;
  d.young_modulus = s.normal_stiffness / softness;
  d.poisson_ratio = key.particle_poisson_ratio;
  d.tolerance = 1e-8;  // so that any motion has the converged stiffness, which the predictions have, within 1e-6
  return d;
}

/// `in` as input_of() gives it.
StabilityPoint measure(const Subject& subject, SimulationInput in, double softness, double fraction, const StabilityGrid& grid) {
  in.time_step = fraction * subject.critical_step();
  const Start start = subject.worst(in.deformation, in.time_step);
  StabilityPoint point{softness, fraction, std::abs(start.factor) - 1.0, {}, false, {}, false};
  if (start.motionless > std::max(kNoGrowth, kDrowned * std::log(std::abs(start.factor)))) {
    point.predicted = std::expm1(start.motionless);
    point.unseen = true;
    return point;
  }
  if (grid.disturb) grid.disturb(in);
  point.measured = release(subject, start, in);
  point.noise_grew = noise_grows(subject, in);
  if (point.predicted > kNoiseGrowth) point.noise_should_grow = true;
  if (point.predicted < kGrowthFloor) point.noise_should_grow = false;
  return point;
}

std::vector<double> decades(double from, double to, int per_decade) {
  std::vector<double> values;
  const int n = static_cast<int>(std::lround(std::log10(to / from) * per_decade));
  for (int k = 0; k <= n; ++k) values.push_back(from * std::pow(10.0, static_cast<double>(k) / per_decade));
  return values;
}

/// Where no step is stable any more the limit drops: the softness of the drop is bracketed within 1 %.
void trace_boundary(StabilityMap& map, const std::function<double(double)>& largest_fraction) {
  const auto add = [&](double softness, double fraction) {
    map.boundary_softness.push_back(softness);
    map.boundary_fraction.push_back(fraction);
  };
  for (const double softness : decades(map.softness.front(), map.softness.back(), 8)) {
    const double fraction = largest_fraction(softness);
    if (fraction == 0.0 && !map.boundary_fraction.empty() && map.boundary_fraction.back() > 0.0) {
      double stable = map.boundary_softness.back(), unstable = softness;
      while (unstable > 1.01 * stable) {
        const double middle = std::sqrt(stable * unstable), there = largest_fraction(middle);
        if (there > 0.0) add(stable = middle, there);
        else unstable = middle;
      }
      add(unstable, 0.0);
    }
    add(softness, fraction);
  }
}

}  // namespace

std::string name(const StabilityKey& key) {
  const char* packing = key.packing == StripPacking::hexagonal ? "lattice" : "random";
  if (key.scheme == Scheme::none) return fmt::format("{}, DEM, kₜ/kₙ = {:g}", packing, key.stiffness_ratio);
  return fmt::format("{}, {} {}, kₜ/kₙ = {:g}, νₚ = {:g}", packing, key.scheme == Scheme::lagged ? "lagged" : "implicit", symbol(key.correction), key.stiffness_ratio,
                     key.particle_poisson_ratio);
}

std::string slug(const StabilityKey& key) {
  const char* packing = key.packing == StripPacking::hexagonal ? "hexagonal" : "random";
  if (key.scheme == Scheme::none) return fmt::format("{}/dem/kt{:.2f}", packing, key.stiffness_ratio);
  return fmt::format("{}/{}-{}/kt{:.2f}/nu{:.2f}", packing, key.scheme == Scheme::lagged ? "lagged" : "implicit", slug(key.correction), key.stiffness_ratio, key.particle_poisson_ratio);
}

StabilityGrid stability_grid(bool full) {
  StabilityGrid g;
  g.step_fraction = full ? std::vector<double>{0.02, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.99, 1.1}
                         : std::vector<double>{0.02, 0.15, 0.3, 0.45, 0.6, 0.75, 0.88, 0.99, 1.1};
  g.softness = decades(0.01, 10.0, full ? 8 : 2);
  g.random_step_fraction = full ? g.step_fraction : std::vector<double>{0.02, 0.3, 0.6, 0.9, 1.1};
  g.random_softness = decades(0.01, 10.0, full ? 4 : 2);
  if (full) g.random_discs = 40;
  const auto add = [&](StripPacking packing, const std::vector<double>& ratios, const std::vector<double>& poissons) {
    for (const double ratio : ratios) {
      g.maps.push_back({packing, Scheme::none, Correction::full, ratio, 0.0});
      for (const double nu : poissons) {
        for (const Scheme scheme : {Scheme::lagged, Scheme::implicit}) {
          for (const Correction c : {Correction::normal, Correction::full, Correction::normal_only_stress}) g.maps.push_back({packing, scheme, c, ratio, nu});
        }
      }
    }
  };
  if (full) {
    add(StripPacking::hexagonal, {0.0, 0.1, 0.3, 0.32, 0.35, 0.5, 1.0}, {0.0, 0.3, 0.45});
    add(StripPacking::random, {0.0, 0.3, 1.0}, {0.3, 0.45});
  } else {
    add(StripPacking::hexagonal, {0.3}, {0.3});
    add(StripPacking::random, {0.3}, {0.3});
  }
  if (!full) {  // without shear stiffness, where all corrections are one; the published correction beyond its limit
    g.maps.push_back({StripPacking::hexagonal, Scheme::lagged, Correction::full, 0.0, 0.3});
    g.maps.push_back({StripPacking::hexagonal, Scheme::implicit, Correction::full, 0.0, 0.3});
    g.maps.push_back({StripPacking::hexagonal, Scheme::lagged, Correction::normal, 0.5, 0.3});
  }
  return g;
}

double StabilityPoint::disagreement() const {
  if (unseen) return 0.0;
  if (!measured) return std::numeric_limits<double>::infinity();
  return std::abs(*measured - predicted) / std::max(std::abs(predicted), kGrowthFloor);
}

bool StabilityPoint::wrong_side() const {
  if (noise_should_grow && *noise_should_grow != noise_grew) return true;
  return measured && ((predicted > kGrowthFloor && *measured <= 0.0) || (predicted <= 0.0 && *measured > kGrowthFloor));
}

double StabilityMap::worst_disagreement() const {
  double worst = 0.0;
  for (const StabilityPoint& p : points) worst = std::max(worst, p.disagreement());
  return worst;
}

int StabilityMap::wrong_sides() const {
  return static_cast<int>(std::count_if(points.begin(), points.end(), [](const StabilityPoint& p) { return p.wrong_side(); }));
}

StabilityMap map_stability(const StripCampaign& s, const StabilityGrid& grid, const StabilityKey& key) {
  const bool lattice = key.packing == StripPacking::hexagonal, rigid = key.scheme == Scheme::none;
  StabilityMap map{key, "", rigid ? std::vector<double>{1.0} : lattice ? grid.softness : grid.random_softness,
                   lattice ? grid.step_fraction : grid.random_step_fraction, {}, {}, {}};
  try {
    const Subject subject = subject_of(s, grid, key);
    std::vector<SimulationInput> inputs;
    for (const double softness : map.softness) inputs.push_back(input_of(subject, strains(s, key, softness)));
    for (const double fraction : map.step_fraction) {
      for (std::size_t k = 0; k < inputs.size(); ++k) map.points.push_back(measure(subject, inputs[k], map.softness[k], fraction, grid));
    }
    // Without an energy a random packing has no sharp limit: it flutters at any step.
    if (rigid || (!lattice && key.correction == Correction::normal && key.stiffness_ratio > 0.0)) return map;
    trace_boundary(map, [&](double softness) { return subject.largest_step(strains(s, key, softness)) / subject.critical_step(); });
  } catch (const std::exception& e) {
    map.failure = e.what();
  }
  return map;
}

}  // namespace ddem::harness
