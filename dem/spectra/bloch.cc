#include "dem/spectra/bloch.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "dem/spectra/dense_eigen.h"

namespace ddem {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;

constexpr const char* kBlochWaves = "Bloch waves";
constexpr int kBonds = 3;
constexpr int kZonePoints = 24;       // a multiple of 6: the corners (1/3, 1/3) and edge centres (1/2, 0) are on the grid
constexpr int kGridRefinements = 6;   // of the grid around its worst wave, by 2 each: a maximum is then right to 1e-5
// Rotations are often fastest in the centre of the zone, where the translations' z = 1 is a defective double eigenvalue.
constexpr double kNearCentre = 1e-3;
constexpr double kStepAccuracy = 1e-4;
constexpr double kMotion = 1e-10;     // of a unit state (u, dt v, eps): less is the round-off of strains that move nothing

struct Direction2 {
  double x, y;
};

std::array<Direction2, kBonds> bond_directions(double row_angle) {
  std::array<Direction2, kBonds> n{};
  for (int b = 0; b < kBonds; ++b) {
    const double angle = row_angle + b * std::numbers::pi / 3.0;
    n[b] = {std::cos(angle), std::sin(angle)};
  }
  return n;
}

/// One product, whatever its factors are made of: each kind would be compiled by itself.
MatrixXcd times(const MatrixXcd& a, const MatrixXcd& b) { return a * b; }

MatrixXcd power(const MatrixXcd& m, int exponent) {
  MatrixXcd result = MatrixXcd::Identity(m.rows(), m.cols());
  for (int k = 0; k < exponent; ++k) result = times(result, m);
  return result;
}

/// 1 + R + ... + R^(terms - 1).
MatrixXcd power_sum(const MatrixXcd& m, int terms) {
  MatrixXcd sum = MatrixXcd::Zero(m.rows(), m.cols());
  for (int k = 0; k < terms; ++k) sum = MatrixXcd::Identity(m.rows(), m.cols()) + times(m, sum);
  return sum;
}

void require_positive(double value, const char* what) {
  if (!(value > 0.0) || !std::isfinite(value)) throw std::invalid_argument(std::string("Bloch waves: ") + what + " must be positive");
}

}  // namespace

HexagonalBloch::HexagonalBloch(const HexagonalLattice& lattice, const ContactParameters& contact,
                               const DeformationParameters& deformation)
    : lattice_(lattice),
      deformation_(deformation),
      dofs_(contact.has_rotation() ? 3 : 2),
      rows_(contact.has_rotation() ? 2 : 1) {
  require_positive(lattice.radius, "the radius");
  require_positive(lattice.density, "the density");
  require_positive(lattice.thickness, "the thickness");
  require_positive(contact.normal_stiffness, "the normal stiffness");
  stiffness_.resize(rows_ * kBonds);
  for (int r = 0; r < rows_ * kBonds; ++r) {
    stiffness_[r] = r % rows_ == 0 ? contact.normal_stiffness : contact.shear_stiffness();
  }
  const double volume = std::numbers::pi * lattice.radius * lattice.radius * lattice.thickness;
  const double mass = lattice.density * volume;
  inverse_mass_ = Eigen::VectorXd::Constant(dofs_, 1.0 / mass);
  if (dofs_ == 3) inverse_mass_[2] = 2.0 / mass;  // I = m r^2 / 2
  if (!deformation.active()) return;
  require_positive(deformation.young_modulus, "Young's modulus of the discs");
  const Compliance d = disc_compliance(deformation);
  const double det = d.direct * d.direct - d.coupling * d.coupling;
  // Work conjugate of (eps_xx, eps_yy, eps_xy) is (s_xx, s_yy, 2 s_xy).
  strain_stiffness_ << d.direct / det, -d.coupling / det, 0.0, -d.coupling / det, d.direct / det, 0.0, 0.0, 0.0, 2.0 / d.shear;
  const double solid_fraction = std::numbers::pi / (2.0 * std::numbers::sqrt3);
  const double share = deformation.volume == ParticleVolume::cell ? 1.0 / solid_fraction : 1.0;
  strain_stiffness_ *= share * volume / (lattice.radius * lattice.radius);
}

HexagonalBloch::Cell HexagonalBloch::cell(WaveVector k) const {
  Cell c{Matrix::Zero(rows_ * kBonds, dofs_), Matrix::Zero(rows_ * kBonds, 3), Matrix::Zero(3, rows_ * kBonds)};
  const auto directions = bond_directions(lattice_.row_angle);
  const bool correct_slip = deformation_.correction == Correction::full;
  const bool stress_of_shear = deformation_.correction != Correction::normal_only_stress;
  for (int b = 0; b < kBonds; ++b) {
    const auto [nx, ny] = directions[b];
    const Complex f = std::polar(1.0, 2.0 * lattice_.radius * (k.x * nx + k.y * ny));
    const int row = rows_ * b;
    c.overlap.row(row).head(2) << nx * (f - 1.0), ny * (f - 1.0);
    const Eigen::RowVector3cd normal = (1.0 + f) * Eigen::RowVector3cd(nx * nx, ny * ny, 2.0 * nx * ny);
    c.strain_overlap.row(row) = normal;
    c.stress.col(row) = normal.adjoint();
    if (rows_ == 1) continue;
    c.overlap.row(row + 1) << -ny * (f - 1.0), nx * (f - 1.0), -(1.0 + f);
    const Eigen::RowVector3cd tangential = (1.0 + f) * Eigen::RowVector3cd(-nx * ny, nx * ny, nx * nx - ny * ny);
    if (correct_slip) c.strain_overlap.row(row + 1) = tangential;
    if (stress_of_shear) c.stress.col(row + 1) = tangential.adjoint();
  }
  return c;
}

HexagonalBloch::Matrix HexagonalBloch::converged_stiffness(const Cell& c) const {
  const Matrix kc = stiffness_.asDiagonal() * c.overlap;
  if (!deformation_.active()) return times(c.overlap.adjoint(), kc);
  const Matrix kg = stiffness_.asDiagonal() * c.strain_overlap;
  const Matrix inner = strain_stiffness_.cast<Complex>() + times(c.stress, kg);
  return times(c.overlap.adjoint(), kc - times(kg, inner.partialPivLu().solve(times(c.stress, kc))));
}

HexagonalBloch::Matrix HexagonalBloch::scaled_stiffness(WaveVector k) const {
  const Eigen::VectorXd s = inverse_mass_.cwiseSqrt();
  return s.asDiagonal() * converged_stiffness(cell(k)) * s.asDiagonal();
}

bool HexagonalBloch::conserves() const {
  return !deformation_.active() || rows_ == 1 || deformation_.correction != Correction::normal;
}

Eigen::VectorXcd HexagonalBloch::squared_frequencies(WaveVector k) const {
  const Matrix a = scaled_stiffness(k);
  if (!conserves()) return eigenvalues(a, kBlochWaves);
  return symmetric_eigenvalues(Matrix(0.5 * (a + a.adjoint())), kBlochWaves).cwiseMax(0.0).cast<Complex>();
}

std::vector<Branch> HexagonalBloch::branches(WaveVector k) const {
  const EigenPairs pairs = eigen_pairs(scaled_stiffness(k), kBlochWaves);
  std::vector<Branch> result;
  for (int b = 0; b < dofs_; ++b) {
    const Complex squared = pairs.values[b];
    // Round-off of an eigenvalue that an energy makes real and not negative.
    const Complex omega = conserves() ? std::sqrt(std::max(0.0, squared.real())) : std::sqrt(squared);
    result.push_back({omega, pairs.vectors.col(b).normalized()});
  }
  std::sort(result.begin(), result.end(),
            [](const Branch& a, const Branch& b) { return a.frequency.real() < b.frequency.real(); });
  return result;
}

std::vector<Complex> HexagonalBloch::frequencies(WaveVector k) const {
  std::vector<Complex> omega;
  for (const Complex& squared : squared_frequencies(k)) omega.push_back(std::sqrt(squared));
  std::sort(omega.begin(), omega.end(), [](const Complex& a, const Complex& b) { return a.real() < b.real(); });
  return omega;
}

/// With R = 1 - w - w T the strains of a step are eps_0 = eps, eps_{m+1} = R eps_m + w H u, T = (V C)^-1 S K G,
/// H = (V C)^-1 S K C; the force takes eps_{s-1}, and the next step starts from eps_s.
HexagonalBloch::Matrix HexagonalBloch::lagged_map(const Cell& c, double dt) const {
  const double w = deformation_.relaxation;
  const int s = deformation_.evaluations;
  const Matrix kc = stiffness_.asDiagonal() * c.overlap, kg = stiffness_.asDiagonal() * c.strain_overlap;
  const Eigen::Matrix3d vc_inverse = strain_stiffness_.inverse();
  const Matrix t = times(vc_inverse.cast<Complex>(), times(c.stress, kg)), h = times(vc_inverse.cast<Complex>(), times(c.stress, kc));
  const Matrix r = (1.0 - w) * Matrix::Identity(3, 3) - w * t;
  const Matrix push = -dt * dt * inverse_mass_.cast<Complex>().asDiagonal() * c.overlap.adjoint();

  const int n = dofs_;
  Matrix map = Matrix::Zero(2 * n + 3, 2 * n + 3);
  map.block(n, 0, n, n) = times(push, kc - times(kg, times(w * power_sum(r, s - 1), h)));
  map.block(n, n, n, n) = Matrix::Identity(n, n);
  map.block(n, 2 * n, n, 3) = -times(times(push, kg), power(r, s - 1));
  map.topRows(n) = map.middleRows(n, n);
  map.topLeftCorner(n, n) += Matrix::Identity(n, n);
  map.block(2 * n, 0, 3, n) = times(w * power_sum(r, s), h);
  map.block(2 * n, 2 * n, 3, 3) = power(r, s);
  return map;
}

std::vector<Complex> HexagonalBloch::multipliers(WaveVector k, double dt) const {
  std::vector<Complex> z;
  if (deformation_.scheme == Scheme::lagged) {
    for (const Complex& value : eigenvalues(lagged_map(cell(k), dt), kBlochWaves)) z.push_back(value);
    return z;
  }
  // Leapfrog: z - 2 + 1/z = -(omega dt)^2.
  for (const Complex& squared : squared_frequencies(k)) {
    const Complex half = 1.0 - 0.5 * dt * dt * squared, root = std::sqrt(half * half - 1.0);
    z.push_back(half + root);
    z.push_back(half - root);
  }
  return z;
}

std::vector<WaveMode> HexagonalBloch::modes(WaveVector k, double dt) const {
  std::vector<WaveMode> result;
  if (deformation_.scheme == Scheme::lagged) {
    const EigenPairs pairs = eigen_pairs(lagged_map(cell(k), dt), kBlochWaves);
    for (int m = 0; m < 2 * dofs_ + 3; ++m) {
      Eigen::VectorXcd motion = pairs.vectors.col(m).head(dofs_);
      const double size = motion.norm();
      motion *= size > kMotion ? 1.0 / size : 0.0;
      result.push_back({pairs.values[m], motion});
    }
    return result;
  }
  for (const Branch& b : branches(k)) {
    const Complex half = 1.0 - 0.5 * dt * dt * b.frequency * b.frequency, root = std::sqrt(half * half - 1.0);
    result.push_back({half + root, b.motion});
    result.push_back({half - root, b.motion});
  }
  return result;
}

Complex HexagonalBloch::multiplier_of(WaveVector k, double dt, double frequency) const {
  const std::vector<Complex> all = multipliers(k, dt);
  const Complex expected = std::polar(1.0, frequency * dt);
  return *std::min_element(all.begin(), all.end(),
                           [&](const Complex& a, const Complex& b) { return std::abs(a - expected) < std::abs(b - expected); });
}

double HexagonalBloch::growth(WaveVector k, double dt) const {
  double largest = 0.0;
  for (const Complex& z : multipliers(k, dt)) largest = std::max(largest, std::abs(z));
  return largest - 1.0;
}

WorstWave HexagonalBloch::worst_wave(double dt) const {
  // Reciprocal vectors of the bonds d_0 and d_1: b_i.d_j = 2 pi delta_ij. z(-k) is the conjugate of z(k): half the zone.
  const auto n = bond_directions(lattice_.row_angle);
  const double scale = std::numbers::pi / (lattice_.radius * (n[0].x * n[1].y - n[0].y * n[1].x));
  const auto wave = [&](double a, double b) {
    return WaveVector{scale * (a * n[1].y - b * n[0].y), scale * (-a * n[1].x + b * n[0].x)};
  };
  double a = 0.0, b = 0.0, worst = -1.0;
  const auto look = [&](double at_a, double at_b) {
    const double here = growth(wave(at_a, at_b), dt);
    if (here > worst) worst = here, a = at_a, b = at_b;
  };
  for (int i = 0; i <= kZonePoints / 2; ++i) {
    for (int j = 0; j < kZonePoints; ++j) {
      const double at_a = i + j > 0 ? static_cast<double>(i) / kZonePoints : kNearCentre;
      look(at_a, static_cast<double>(j) / kZonePoints);
    }
  }
  double spacing = 0.5 / kZonePoints;
  for (int level = 0; level < kGridRefinements; ++level, spacing *= 0.5) {
    const double centre_a = a, centre_b = b;
    for (const double da : {-spacing, 0.0, spacing}) {
      for (const double db : {-spacing, 0.0, spacing}) look(centre_a + da, centre_b + db);
    }
  }
  return {worst, wave(a, b)};
}

std::optional<double> HexagonalBloch::largest_stable_step() const {
  // A step so small that what grows there grows at any: the largest frequency is at most the root of this trace.
  const double trace = 4.0 * stiffness_.sum() * inverse_mass_.sum();
  double low = 1e-2 * 2.0 / std::sqrt(trace), high = low;
  if (worst_wave(low).growth > kNoGrowth) return std::nullopt;
  while (worst_wave(high).growth <= kNoGrowth) low = high, high *= 2.0;
  while (high - low > kStepAccuracy * low) {
    const double middle = 0.5 * (low + high);
    (worst_wave(middle).growth <= kNoGrowth ? low : high) = middle;
  }
  return low;
}

}  // namespace ddem
