#include "fem_reference/kernel/elastic_operator.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "fem_reference/kernel/gauss_lobatto.h"

namespace ddem::fem {
namespace {

double determinant(const std::array<double, 4>& j) {
  return j[0] * j[3] - j[1] * j[2];
}

void check(const ElementMesh& mesh) {
  const std::size_t points = mesh.points_per_element(), elements = mesh.element_count();
  const bool fits = mesh.jacobians.size() == elements || mesh.jacobians.size() == elements * points;
  if (elements == 0 || mesh.nodes.size() != elements * points || !fits) {
    throw std::invalid_argument("a mesh needs (degree+1)^2 nodes for each of its elements, and an element");
  }
  for (const std::uint32_t node : mesh.nodes) {
    if (node >= mesh.node_count) throw std::invalid_argument("an element names a node that is not there");
  }
  for (const auto& j : mesh.jacobians) {
    if (!(determinant(j) > 0.0) || !std::isfinite(determinant(j))) {
      throw std::invalid_argument("an element is turned over or has no area");
    }
  }
}

// c_ijkl of an isotropic plane: lambda d_ij d_kl + mu (d_ik d_jl + d_il d_jk).
double stiffness(const PlaneMaterial& m, int i, int j, int k, int l) {
  return m.lame_lambda * (i == j) * (k == l) + m.shear_modulus * ((i == k) * (j == l) + (i == l) * (j == k));
}

std::array<double, coefficients_per_element> coefficients(const std::array<double, 4>& jacobian,
                                                          const PlaneMaterial& material) {
  const double det = determinant(jacobian);
  const double inverse[2][2] = {{jacobian[3] / det, -jacobian[1] / det},
                                {-jacobian[2] / det, jacobian[0] / det}};  // d(xi, eta)/d(x, y)
  std::array<double, coefficients_per_element> c{};
  std::size_t entry = 0;
  for (int row = 0; row < 4; ++row) {
    for (int column = row; column < 4; ++column, ++entry) {
      for (int j = 0; j < 2; ++j) {
        for (int l = 0; l < 2; ++l) {
          c[entry] += det * inverse[row % 2][j] * stiffness(material, row / 2, j, column / 2, l) *
                      inverse[column % 2][l];
        }
      }
    }
  }
  return c;
}

// Edges along x and y, to the round-off of a mesh generator's coordinates.
ElementShape shape_of(const ElementMesh& mesh) {
  if (!mesh.affine()) return ElementShape::general;
  const bool upright = std::all_of(mesh.jacobians.begin(), mesh.jacobians.end(), [](const auto& j) {
    return std::max(std::abs(j[1]), std::abs(j[2])) <= 1e-12 * std::min(std::abs(j[0]), std::abs(j[3]));
  });
  return upright ? ElementShape::rectangle : ElementShape::parallelogram;
}

// A of n x n with A(n-1-q, n-1-k) = -A(q, k), which derivatives on symmetric points have. With h = n/2, m = n-1-k:
// (A(q, k) + A(q, m))/2, then (A(q, k) - A(q, m))/2, each for q, k < h, rows q; if n is odd, A(h, k) for k < h, and
// A(q, h) for q < h.
std::vector<double> halves(const std::vector<double>& a, std::size_t n) {
  const std::size_t h = n / 2;
  std::vector<double> result;
  for (const double sign : {1.0, -1.0}) {
    for (std::size_t q = 0; q < h; ++q) {
      for (std::size_t k = 0; k < h; ++k) result.push_back(0.5 * (a[q * n + k] + sign * a[q * n + n - 1 - k]));
    }
  }
  if (n % 2 == 0) return result;
  for (std::size_t k = 0; k < h; ++k) result.push_back(a[h * n + k]);
  for (std::size_t q = 0; q < h; ++q) result.push_back(a[q * n + h]);
  return result;
}

std::vector<double> weighted_transpose(const GaussLobatto& rule) {
  const std::size_t n = rule.points.size();
  std::vector<double> result(n * n);
  for (std::size_t q = 0; q < n; ++q) {
    for (std::size_t k = 0; k < n; ++k) result[k * n + q] = rule.weights[q] * rule.derivative[q * n + k];
  }
  return result;
}

}  // namespace

ElasticOperator::ElasticOperator(const ElementMesh& mesh, const PlaneMaterial& material, InstructionSet set)
    : kernel_(stiffness_kernel(mesh.degree, shape_of(mesh), set)) {
  check(mesh);
  GaussLobatto rule = gauss_lobatto(mesh.degree);
  derivative_ = halves(rule.derivative, rule.points.size());
  divergence_ = halves(weighted_transpose(rule), rule.points.size());
  weights_ = std::move(rule.weights);
  add_mass(mesh, material.density);
  pack(mesh, material);
  colour_blocks();
}

void ElasticOperator::add_mass(const ElementMesh& mesh, double density) {
  const std::size_t n = mesh.degree + 1;
  mass_.assign(mesh.node_count, 0.0);
  for (std::size_t element = 0; element < mesh.element_count(); ++element) {
    for (std::size_t point = 0; point < n * n; ++point) {
      const std::size_t place = element * n * n + point;
      const double total = density * determinant(mesh.jacobians[mesh.affine() ? element : place]);
      mass_[mesh.nodes[place]] += total * weights_[point % n] * weights_[point / n];
    }
  }
  if (std::any_of(mass_.begin(), mass_.end(), [](double m) { return !(m > 0.0); })) {
    throw std::invalid_argument("a node belongs to no element");
  }
}

void ElasticOperator::pack(const ElementMesh& mesh, const PlaneMaterial& material) {
  const std::size_t points = mesh.points_per_element(), sets = mesh.affine() ? 1 : points;
  const std::size_t batches = (mesh.element_count() + lanes - 1) / lanes;
  // Lanes without an element work on the padding node with coefficients zero.
  batch_nodes_.assign(batches * points * lanes, static_cast<std::uint32_t>(mesh.node_count));
  batch_coefficients_.assign(batches * sets * coefficients_per_element * lanes, 0.0);
  for (std::size_t element = 0; element < mesh.element_count(); ++element) {
    const std::size_t batch = element / lanes, lane = element % lanes;
    for (std::size_t point = 0; point < points; ++point) {
      batch_nodes_[(batch * points + point) * lanes + lane] = mesh.nodes[element * points + point];
    }
    for (std::size_t point = 0; point < sets; ++point) {
      const auto c = coefficients(mesh.jacobians[element * sets + point], material);
      for (std::size_t k = 0; k < c.size(); ++k) {
        batch_coefficients_[((batch * sets + point) * coefficients_per_element + k) * lanes + lane] = c[k];
      }
    }
  }
}

void ElasticOperator::colour_blocks() {
  constexpr std::size_t blocks_at_most = 128;
  constexpr unsigned most_colours = 64;
  const std::size_t nodes_per_batch = lanes * weights_.size() * weights_.size();
  const std::size_t batches = batch_nodes_.size() / nodes_per_batch;
  const std::size_t size = (batches + blocks_at_most - 1) / blocks_at_most;
  std::vector<std::uint64_t> taken(mass_.size() + 1, 0);  // colours of the blocks that a node belongs to
  for (std::size_t first = 0; first < batches; first += size) {
    const Block block{first, std::min(batches, first + size)};
    const auto begin = batch_nodes_.begin() + static_cast<std::ptrdiff_t>(block.first_batch * nodes_per_batch);
    const auto end = batch_nodes_.begin() + static_cast<std::ptrdiff_t>(block.last_batch * nodes_per_batch);
    std::uint64_t forbidden = 0;
    for (auto node = begin; node != end; ++node) forbidden |= taken[*node];
    const auto colour = static_cast<unsigned>(std::countr_one(forbidden));
    if (colour >= most_colours) throw std::invalid_argument("too many elements meet at a node");
    for (auto node = begin; node != end; ++node) taken[*node] |= std::uint64_t{1} << colour;
    if (colour == colours_.size()) colours_.emplace_back();
    colours_[colour].push_back(block);
  }
}

void ElasticOperator::apply(std::span<const double> u, std::span<double> f) const {
  if (u.size() != vector_size() || f.size() != vector_size()) {
    throw std::invalid_argument("displacement and force must have vector_size() entries");
  }
  team_->run([&](int thread) { apply_share(u, f, thread); });
}

void ElasticOperator::apply_share(std::span<const double> u, std::span<double> f, int thread) const {
  const auto [first, last] = team_->part(f.size(), thread);
  std::fill(f.begin() + static_cast<std::ptrdiff_t>(first), f.begin() + static_cast<std::ptrdiff_t>(last), 0.0);
  team_->meet(thread);
  for (const std::vector<Block>& blocks : colours_) {
    const auto [first_block, last_block] = team_->part(blocks.size(), thread);
    for (std::size_t b = first_block; b < last_block; ++b) {
      const KernelData data{blocks[b].first_batch,      blocks[b].last_batch, batch_nodes_.data(),
                            batch_coefficients_.data(), derivative_.data(),   divergence_.data(),
                            weights_.data()};
      kernel_(data, u.data(), f.data());
    }
    team_->meet(thread);
  }
  if (processes_ == nullptr) return;
  if (thread == 0) processes_->add_shared(f);
  team_->meet(thread);
}

void ElasticOperator::use(Processes& processes) {
  processes_ = &processes;
  std::vector<double> mass(vector_size(), 0.0);
  for (std::size_t node = 0; node < mass_.size(); ++node) mass[2 * node] = mass_[node];
  processes.add_shared(mass);
  for (std::size_t node = 0; node < mass_.size(); ++node) mass_[node] = mass[2 * node];
}

double ElasticOperator::dot(std::span<const double> a, std::span<const double> b) const {
  double sum = 0.0;
  if (processes_ == nullptr) {
    // A sum a lane: one sum would wait for every addition.
    std::array<double, lanes> sums{};
    const std::size_t whole = a.size() - a.size() % lanes;
    for (std::size_t k = 0; k < whole; k += lanes) {
      for (std::size_t lane = 0; lane < lanes; ++lane) sums[lane] += a[k + lane] * b[k + lane];
    }
    for (std::size_t k = whole; k < a.size(); ++k) sum += a[k] * b[k];
    for (const double part : sums) sum += part;
    return sum;
  }
  const std::vector<double>& owned = processes_->owned();
  for (std::size_t k = 0; k < 2 * owned.size(); ++k) sum += owned[k / 2] * a[k] * b[k];
  processes_->sum({&sum, 1});
  return sum;
}

}  // namespace ddem::fem
