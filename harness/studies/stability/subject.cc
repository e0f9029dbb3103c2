#include "harness/studies/stability/subject.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "dem/assembly/contacts.h"
#include "dem/spectra/spectra.h"
#include "dem/spectra/step_map.h"
#include "meshes/packings/hexagonal.h"
#include "meshes/packings/random.h"

namespace ddem::harness {
namespace {

constexpr int kCells = 6;         // of the lattice along each side: holds the corners and edge centres of the zone
constexpr double kLatticeRadius = 1e-4;  // m; nothing depends on it

/// Those of the periodic piece, one of all that the lattice's rotations and mirrors take into each other: they have the same
/// factors.
std::vector<WaveVector> waves_of_the_cell() {
  std::vector<WaveVector> waves;
  std::set<std::array<int, 3>> seen;
  const double unit = 2.0 * std::numbers::pi / (kCells * kLatticeRadius);
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

}  // namespace

Subject::Subject(ddem::Assembly assembly, bool lattice, const ContactParameters& contact) : a_(std::move(assembly)), lattice_(lattice), contact_(contact) {
  critical_ = 2.0 / largest_frequency(a_, contact_, {});
  if (lattice_) waves_ = waves_of_the_cell();
}

Start Subject::worst(const DeformationParameters& d, double dt) const {
  return lattice_ ? worst_wave(d, dt) : worst_mode(d, dt);
}

HexagonalBloch Subject::bloch(const DeformationParameters& d) const {
  return {{kLatticeRadius, a_.density, a_.thickness, 0.0}, contact_, d};
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
    const Packing p = packings::hexagonal({.columns = kCells, .rows = kCells, .radius = kLatticeRadius, .periodic_x = true, .periodic_y = true});
    return {make_assembly(p, bonds_within_gap(p, 0.1 * kLatticeRadius), 1.0, s.density), true, contact};
  }
  // Square, of mean radius near kLatticeRadius: the discs fill 0.85 of it.
  const double side = std::sqrt(grid.random_discs * std::numbers::pi / 0.85) * kLatticeRadius;
  const Packing p = packings::random_jammed({.length = side, .width = side, .discs = grid.random_discs, .seed = static_cast<std::uint64_t>(s.seeds.front())});
  return {make_assembly(p, bonds_within_gap(p, 0.3 * mean_radius(p)), 1.0, s.density, RattlerRule::peel), false, contact};
}

}  // namespace ddem::harness
