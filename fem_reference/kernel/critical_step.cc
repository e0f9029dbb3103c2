#include "fem_reference/kernel/critical_step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace ddem::fem {
namespace {

constexpr int largest_krylov_dimension = 2000;
constexpr int test_interval = 10;

// Mixes the bits of a number (splitmix64), as a number between -1/2 and 1/2.
double noise(std::uint64_t state) {
  state += 0x9E3779B97F4A7C15u;
  state = (state ^ (state >> 30)) * 0xBF58476D1CE4E5B9u;
  state = (state ^ (state >> 27)) * 0x94D049BB133111EBu;
  return static_cast<double>((state ^ (state >> 31)) >> 11) * 0x1p-53 - 0.5;
}

// A start with a part in every mode: no symmetry of the mesh can hide the largest one.
std::vector<double> pseudo_random_start(const ElasticOperator& stiffness, std::span<const double> root_inverse_mass,
                                        std::span<const std::uint64_t> node_keys) {
  std::vector<double> start(root_inverse_mass.size(), 0.0);
  for (std::size_t k = 0; k < 2 * stiffness.node_count(); ++k) {
    const std::uint64_t key = node_keys.empty() ? k / 2 : node_keys[k / 2];
    if (root_inverse_mass[k] > 0.0) start[k] = noise(2 * key + k % 2);
  }
  const double norm = std::sqrt(stiffness.dot(start, start));
  if (!(norm > 0.0)) throw std::invalid_argument("no degree of freedom is free");
  for (double& value : start) value /= norm;
  return start;
}

// Whether all eigenvalues of the tridiagonal matrix lie below x: the pivots of T - x I are all negative.
bool all_below(double x, const std::vector<double>& alpha, const std::vector<double>& beta) {
  double pivot = alpha[0] - x;
  for (std::size_t k = 1; k < alpha.size() && pivot < 0.0; ++k) pivot = alpha[k] - x - beta[k - 1] * beta[k - 1] / pivot;
  return pivot < 0.0;
}

// By bisection to the last bits.
double largest_eigenvalue(const std::vector<double>& alpha, const std::vector<double>& beta) {
  double low = *std::max_element(alpha.begin(), alpha.end()), high = low;
  for (std::size_t k = 0; k < alpha.size(); ++k) {  // Gershgorin
    const double before = k > 0 ? beta[k - 1] : 0.0, after = k + 1 < alpha.size() ? beta[k] : 0.0;
    high = std::max(high, alpha[k] + before + after);
  }
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (low + high);
    (all_below(middle, alpha, beta) ? high : low) = middle;
  }
  return high;
}

struct RitzValue {
  double value, residual;
};

// The largest eigenpair of the tridiagonal matrix; beta_k times the last entry of its vector is the
// residual of the Ritz vector, hence |lambda - theta| <= residual for an eigenvalue lambda.
RitzValue largest_ritz_value(const std::vector<double>& alpha, const std::vector<double>& beta) {
  const std::size_t size = alpha.size();
  const double theta = largest_eigenvalue(alpha, beta);
  // The vector from its last entry, 1, upwards: it grows that way once the iteration converges, so the
  // recurrence is stable.
  double below_entry = 0.0, entry = 1.0, norm2 = 1.0;
  for (std::size_t k = size - 1; k > 0; --k) {
    const double next_beta = k + 1 < size ? beta[k] : 0.0;
    const double above = ((theta - alpha[k]) * entry - next_beta * below_entry) / beta[k - 1];
    below_entry = entry;
    entry = above;
    norm2 += entry * entry;
    if (norm2 > 1e200) break;
  }
  return {theta, beta.back() / std::sqrt(norm2)};
}

// Nodes column after column.
ElementMesh mesh_of(const RectangleStrip& strip) {
  const unsigned p = static_cast<unsigned>(strip.degree), rows = strip.ny * p + (strip.periodic ? 0 : 1);
  ElementMesh mesh;
  mesh.degree = strip.degree;
  mesh.node_count = std::size_t{strip.nx * p + 1} * rows;
  mesh.jacobians.assign(std::size_t{strip.nx} * strip.ny, {strip.hx, 0.0, 0.0, strip.hy});
  for (unsigned x = 0; x < strip.nx; ++x) {
    for (unsigned y = 0; y < strip.ny; ++y) {
      for (unsigned eta = 0; eta <= p; ++eta) {
        for (unsigned xi = 0; xi <= p; ++xi) mesh.nodes.push_back((x * p + xi) * rows + (y * p + eta) % rows);
      }
    }
  }
  return mesh;
}

}  // namespace

double largest_squared_frequency(const ElasticOperator& stiffness, std::span<const double> inverse_mass,
                                 std::span<const std::uint64_t> node_keys) {
  const std::size_t size = stiffness.vector_size();
  if (inverse_mass.size() != size)
    throw std::invalid_argument("inverse mass must have vector_size() entries");
  std::vector<double> root(size), before(size, 0.0), scaled(size), image(size), alpha, beta;
  for (std::size_t k = 0; k < size; ++k) root[k] = std::sqrt(inverse_mass[k]);
  std::vector<double> current = pseudo_random_start(stiffness, root, node_keys);
  for (int step = 1; step <= largest_krylov_dimension; ++step) {
    for (std::size_t k = 0; k < size; ++k) scaled[k] = root[k] * current[k];
    stiffness.apply(scaled, image);
    for (std::size_t k = 0; k < size; ++k) image[k] *= root[k];
    alpha.push_back(stiffness.dot(current, image));
    const double last_beta = beta.empty() ? 0.0 : beta.back();
    for (std::size_t k = 0; k < size; ++k) image[k] -= alpha.back() * current[k] + last_beta * before[k];
    beta.push_back(std::sqrt(stiffness.dot(image, image)));
    const bool exhausted = beta.back() <= 1e-13 * std::abs(alpha.front());
    if (exhausted || step % test_interval == 0) {
      const RitzValue ritz = largest_ritz_value(alpha, beta);
      if (!std::isfinite(ritz.value)) break;
      if (ritz.residual <= eigenvalue_tolerance * ritz.value) return ritz.value + ritz.residual;
    }
    before.swap(current);
    for (std::size_t k = 0; k < size; ++k) current[k] = image[k] / beta.back();
  }
  throw std::runtime_error("Lanczos: the largest eigenfrequency did not converge");
}

double critical_time_step(const ElasticOperator& stiffness, std::span<const double> inverse_mass,
                          std::span<const std::uint64_t> node_keys) {
  return 2.0 / std::sqrt(largest_squared_frequency(stiffness, inverse_mass, node_keys));
}

double critical_time_step(const RectangleStrip& strip, const PlaneMaterial& material, Team& team) {
  const unsigned pieces = strip.nx / (columns_to_cut / 2);
  if (pieces == 0) throw std::invalid_argument("a strip of so few columns is not to be cut");
  const std::array<unsigned, 2> columns{strip.nx / pieces, (strip.nx + pieces - 1) / pieces};
  const std::size_t sizes = columns[0] == columns[1] ? 1 : 2;
  std::array<double, 2> largest{};
  team.run([&](int thread) {
    const auto [first, last] = team.part(sizes, thread);
    for (std::size_t k = first; k < last; ++k) {
      RectangleStrip piece = strip;
      piece.nx = columns[k];
      const ElasticOperator stiffness(mesh_of(piece), material);
      std::vector<double> inverse_mass(stiffness.vector_size(), 0.0);
      for (std::size_t d = 0; d < 2 * stiffness.node_count(); ++d) inverse_mass[d] = 1.0 / stiffness.mass()[d / 2];
      largest[k] = largest_squared_frequency(stiffness, inverse_mass);
    }
  });
  return 2.0 / std::sqrt(std::max(largest[0], largest[1]));
}

}  // namespace ddem::fem
