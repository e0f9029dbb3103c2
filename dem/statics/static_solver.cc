#include "dem/statics/static_solver.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <algorithm>
#include <stdexcept>

namespace ddem {
namespace {

constexpr double kRegularisation = 1e-11;
constexpr double kResidual = 1e-12;
constexpr int kRefinements = 20;

/// Discs in an order of elimination that keeps the factors sparse. Of discs and not of their unknowns, which all are coupled
/// alike: the graph to be ordered is six times smaller, and the unknowns of a disc stay together.
std::vector<int> elimination_order(const Assembly& a) {
  std::vector<Eigen::Triplet<double>> t;
  for (int p = 0; p < static_cast<int>(a.size()); ++p) t.emplace_back(p, p, 1.0);  // without them the order is no order
  for (std::size_t c = 0; c < a.bonds.size(); ++c) {
    t.emplace_back(std::max(a.bonds.i[c], a.bonds.j[c]), std::min(a.bonds.i[c], a.bonds.j[c]), 1.0);
  }
  SparseMatrix graph(static_cast<Eigen::Index>(a.size()), static_cast<Eigen::Index>(a.size()));
  graph.setFromTriplets(t.begin(), t.end());
  Eigen::AMDOrdering<int>::PermutationType order;
  Eigen::AMDOrdering<int>()(graph.selfadjointView<Eigen::Lower>(), order);
  return {order.indices().begin(), order.indices().end()};
}

/// Columns `from` of a matrix, times a factor, to the columns `to`.
struct Columns {
  const SparseMatrix* of;
  const std::vector<int>* to;  ///< a column each, -1: left out
  double factor;
};

SparseMatrix gathered(Eigen::Index columns, std::initializer_list<Columns> parts) {
  SparseMatrix m(parts.begin()->of->rows(), columns);
  if (columns == 0) return m;  // everything is held; Eigen's compressing reads beyond such a matrix
  std::vector<int> entries(static_cast<std::size_t>(columns), 0);
  for (const Columns& part : parts) {
    for (int k = 0; k < part.of->outerSize(); ++k) {
      if ((*part.to)[k] >= 0) entries[(*part.to)[k]] = part.of->outerIndexPtr()[k + 1] - part.of->outerIndexPtr()[k];
    }
  }
  m.reserve(entries);
  for (const Columns& part : parts) {
    for (int k = 0; k < part.of->outerSize(); ++k) {
      if ((*part.to)[k] < 0) continue;
      for (SparseMatrix::InnerIterator it(*part.of, k); it; ++it) m.insert(it.row(), (*part.to)[k]) = part.factor * it.value();
    }
  }
  m.makeCompressed();
  return m;
}

}  // namespace

struct StaticSolver::Impl {
  const Assembly& assembly;
  Operators op;
  std::vector<int> reduced;    ///< unknown of each dof, -1 where held
  std::vector<int> strain_at;  ///< unknown of each strain
  SparseMatrix matrix;         ///< of the unknowns, divided by k_n
  double scale = 1.0;
  Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower, Eigen::NaturalOrdering<int>> ldlt;
  Eigen::SparseLU<SparseMatrix, Eigen::NaturalOrdering<int>> lu;

  explicit Impl(const Assembly& a) : assembly(a) {}

  Eigen::VectorXd apply_inverse(const Eigen::VectorXd& b) const {
    if (op.symmetric) return ldlt.solve(b);
    return lu.solve(b);
  }

  /// Fluctuation, strains and forces that balance these overlaps of the affine or imposed motion.
  StaticState balance(const Eigen::VectorXd& affine) const;

  /// -C^T force over the scale in the rows of displacements, `strain_load` over it in those of strains.
  Eigen::VectorXd load_of(const Eigen::VectorXd& force, const Eigen::VectorXd& strain_load) const {
    Eigen::VectorXd rhs = Eigen::VectorXd::Zero(matrix.rows());
    const Eigen::VectorXd load = op.overlap.transpose() * force;
    for (Eigen::Index d = 0; d < load.size(); ++d) {
      if (reduced[d] >= 0) rhs[reduced[d]] = -load[d] / scale;
    }
    for (Eigen::Index d = 0; d < strain_load.size(); ++d) rhs[strain_at[d]] = strain_load[d] / scale;
    return rhs;
  }

  Eigen::VectorXd refined_solution(const Eigen::VectorXd& rhs, double target) const {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(rhs.size());
    Eigen::VectorXd residual = rhs;
    for (int k = 0; k < kRefinements && residual.norm() > target; ++k) {
      x += apply_inverse(residual);
      residual = rhs - matrix * x;
    }
    if (!(residual.norm() <= target)) {
      throw std::runtime_error("the static solve did not converge: the assembly has a mechanism that the load drives");
    }
    return x;
  }

  /// Fluctuation and strains of a solution; no forces yet.
  StaticState unpack(const Eigen::VectorXd& x) const {
    StaticState state;
    state.fluctuation = Eigen::VectorXd::Zero(op.overlap.cols());
    for (Eigen::Index d = 0; d < state.fluctuation.size(); ++d) {
      if (reduced[d] >= 0) state.fluctuation[d] = x[reduced[d]];
    }
    if (op.deformable()) state.strain = x(strain_at);
    return state;
  }

  /// C q - G eps.
  Eigen::VectorXd overlaps_of(const StaticState& state) const {
    Eigen::VectorXd overlaps = op.overlap * state.fluctuation;
    if (op.deformable()) overlaps -= op.strain_overlap * state.strain;
    return overlaps;
  }

  /// Disc by disc, in the order of elimination.
  void number_unknowns(const HeldDofs& held) {
    reduced.assign(static_cast<std::size_t>(op.overlap.cols()), -1);
    if (op.deformable()) strain_at.resize(static_cast<std::size_t>(op.stress.rows()));
    const auto is_held = [](const std::vector<std::uint8_t>& h, int p) { return !h.empty() && h[p]; };
    int next = 0;
    for (const int p : elimination_order(assembly)) {
      const int d = op.dofs_per_disc * p;
      if (!is_held(held.x, p)) reduced[d] = next++;
      if (!is_held(held.y, p)) reduced[d + 1] = next++;
      if (op.dofs_per_disc == 3 && !is_held(held.theta, p)) reduced[d + 2] = next++;
      if (op.deformable()) {
        for (int k = 0; k < 3; ++k) strain_at[3 * p + k] = next++;
      }
    }
    matrix.resize(next, next);
  }

  /// [C^T; -S] K [C, -G] + V C.
  void build_matrix() {
    const auto all = [this](const SparseMatrix& strain_part) {
      if (!op.deformable()) return gathered(matrix.cols(), {{&op.overlap, &reduced, 1.0}});
      return gathered(matrix.cols(), {{&op.overlap, &reduced, 1.0}, {&strain_part, &strain_at, -1.0}});
    };
    SparseMatrix right = all(op.strain_overlap);
    const SparseMatrix left = op.symmetric ? right.transpose() : all(op.stress.transpose()).transpose();
    for (Eigen::Index k = 0; k < right.nonZeros(); ++k) right.valuePtr()[k] *= op.stiffness[right.innerIndexPtr()[k]] / scale;
    matrix = left * right;
    for (int k = 0; k < op.strain_stiffness.outerSize(); ++k) {
      for (SparseMatrix::InnerIterator it(op.strain_stiffness, k); it; ++it) {
        matrix.coeffRef(strain_at[it.row()], strain_at[it.col()]) += it.value() / scale;
      }
    }
    matrix.makeCompressed();
  }

  void factorise() {
    SparseMatrix regular = matrix;
    for (const int d : reduced) {
      if (d >= 0) regular.coeffRef(d, d) += kRegularisation;
    }
    regular.makeCompressed();
    if (op.symmetric) {
      ldlt.compute(regular);
    } else {
      lu.isSymmetric(true);
      lu.compute(regular);
    }
    if ((op.symmetric ? ldlt.info() : lu.info()) != Eigen::Success) {
      throw std::runtime_error("the static stiffness matrix could not be factorised");
    }
  }
};

Eigen::Vector2d bond_force(const Bonds& b, const Operators& op, const StaticState& state, std::size_t c) {
  const double fn = state.bond_forces[op.rows_per_bond * c];
  const double ft = op.rows_per_bond == 2 ? state.bond_forces[2 * c + 1] : 0.0;
  return {fn * b.nx[c] - ft * b.ny[c], fn * b.ny[c] + ft * b.nx[c]};
}

StaticSolver::StaticSolver(const Assembly& assembly, const ContactParameters& contact,
                           const DeformationParameters& deformation, const HeldDofs& held)
    : impl_(std::make_unique<Impl>(assembly)) {
  impl_->op = make_operators(assembly, contact, deformation);
  impl_->scale = impl_->op.stiffness.maxCoeff();
  impl_->number_unknowns(held);
  impl_->build_matrix();
  impl_->factorise();
}

StaticSolver::~StaticSolver() = default;
StaticSolver::StaticSolver(StaticSolver&&) noexcept = default;

const Operators& StaticSolver::operators() const { return impl_->op; }

StaticState StaticSolver::solve(const MacroStrain& strain) const {
  return impl_->balance(affine_overlaps(impl_->assembly, impl_->op, strain));
}

StaticState StaticSolver::solve_moved(const Eigen::VectorXd& displacement) const {
  StaticState state = impl_->balance(impl_->op.overlap * displacement);
  state.fluctuation += displacement;
  return state;
}

StaticState StaticSolver::Impl::balance(const Eigen::VectorXd& affine) const {
  const Eigen::VectorXd affine_force = op.stiffness.cwiseProduct(affine);
  const Eigen::VectorXd rhs = load_of(affine_force, op.deformable() ? op.stress * affine_force : Eigen::VectorXd());

  // Relative to the affine forces, not to the right-hand side: that one vanishes on a perfect lattice.
  const Eigen::VectorXd x = refined_solution(rhs, kResidual * affine.norm());

  StaticState state = unpack(x);
  state.bond_forces = op.stiffness.cwiseProduct(affine + overlaps_of(state));
  return state;
}

StaticState StaticSolver::rate(const StaticState& state, const OperatorRates& rates) const {
  const Impl& m = *impl_;
  const Eigen::VectorXd overlaps = state.bond_forces.cwiseQuotient(m.op.stiffness);
  const Eigen::VectorXd force = rates.stiffness.cwiseProduct(overlaps);
  Eigen::VectorXd strain_load;
  if (m.op.deformable()) strain_load = m.op.stress * force - rates.strain_stiffness * state.strain;
  const Eigen::VectorXd rhs = m.load_of(force, strain_load);
  StaticState change = m.unpack(m.refined_solution(rhs, kResidual * (rhs.norm() + state.bond_forces.norm() / m.scale)));
  change.bond_forces = force + m.op.stiffness.cwiseProduct(m.overlaps_of(change));
  return change;
}

}  // namespace ddem
