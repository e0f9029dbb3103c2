#include "dem/statics/static_solver.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <stdexcept>

namespace ddem {
namespace {

constexpr double kRegularisation = 1e-11;
constexpr double kResidual = 1e-12;
constexpr int kRefinements = 20;

void append(std::vector<Eigen::Triplet<double>>& t, const SparseMatrix& m, Eigen::Index row, Eigen::Index col,
            double factor) {
  for (int k = 0; k < m.outerSize(); ++k) {
    for (SparseMatrix::InnerIterator it(m, k); it; ++it) {
      t.emplace_back(static_cast<int>(row + it.row()), static_cast<int>(col + it.col()), factor * it.value());
    }
  }
}

}  // namespace

struct StaticSolver::Impl {
  const Assembly& assembly;
  Operators op;
  std::vector<int> reduced;  ///< unknown of each dof, -1 where held
  Eigen::Index free = 0;     ///< unknown displacements and rotations
  SparseMatrix matrix;       ///< of the unknowns, divided by k_n
  double scale = 1.0;
  Eigen::SimplicialLDLT<SparseMatrix> ldlt;
  Eigen::SparseLU<SparseMatrix> lu;

  explicit Impl(const Assembly& a) : assembly(a) {}

  Eigen::VectorXd apply_inverse(const Eigen::VectorXd& b) const {
    if (op.symmetric) return ldlt.solve(b);
    return lu.solve(b);
  }

  /// Fluctuation, strains and forces that balance these overlaps of the affine or imposed motion.
  StaticState balance(const Eigen::VectorXd& affine) const;

  /// -C^T force over the scale in the rows of displacements, zero in those of strains.
  Eigen::VectorXd load_of(const Eigen::VectorXd& force) const {
    Eigen::VectorXd rhs = Eigen::VectorXd::Zero(matrix.rows());
    const Eigen::VectorXd load = op.overlap.transpose() * force;
    for (Eigen::Index d = 0; d < load.size(); ++d) {
      if (reduced[d] >= 0) rhs[reduced[d]] = -load[d] / scale;
    }
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
    if (op.deformable()) state.strain = x.tail(op.stress.rows());
    return state;
  }

  /// C q - G eps.
  Eigen::VectorXd overlaps_of(const StaticState& state) const {
    Eigen::VectorXd overlaps = op.overlap * state.fluctuation;
    if (op.deformable()) overlaps -= op.strain_overlap * state.strain;
    return overlaps;
  }

  void number_unknowns(const HeldDofs& held) {
    reduced.assign(static_cast<std::size_t>(op.overlap.cols()), -1);
    const auto is_held = [](const std::vector<std::uint8_t>& h, std::size_t p) { return !h.empty() && h[p]; };
    int next = 0;
    for (std::size_t p = 0; p < assembly.size(); ++p) {
      const std::size_t d = op.dofs_per_disc * p;
      if (!is_held(held.x, p)) reduced[d] = next++;
      if (!is_held(held.y, p)) reduced[d + 1] = next++;
      if (op.dofs_per_disc == 3 && !is_held(held.theta, p)) reduced[d + 2] = next++;
    }
    free = next;
  }

  /// Columns of C that belong to unknowns.
  SparseMatrix free_overlap() const {
    std::vector<Eigen::Triplet<double>> t;
    for (int k = 0; k < op.overlap.outerSize(); ++k) {
      if (reduced[k] < 0) continue;
      for (SparseMatrix::InnerIterator it(op.overlap, k); it; ++it) {
        t.emplace_back(static_cast<int>(it.row()), reduced[k], it.value());
      }
    }
    SparseMatrix c(op.overlap.rows(), free);
    c.setFromTriplets(t.begin(), t.end());
    return c;
  }

  void build_matrix() {
    const SparseMatrix c = free_overlap();
    const SparseMatrix kc = op.stiffness.asDiagonal() * c;
    std::vector<Eigen::Triplet<double>> t;
    append(t, SparseMatrix(c.transpose()) * kc, 0, 0, 1.0 / scale);
    const Eigen::Index strains = op.deformable() ? op.strain_overlap.cols() : 0;
    if (op.deformable()) {
      const SparseMatrix kg = op.stiffness.asDiagonal() * op.strain_overlap;
      append(t, SparseMatrix(c.transpose()) * kg, 0, free, -1.0 / scale);
      append(t, op.stress * kc, free, 0, -1.0 / scale);
      append(t, op.stress * kg, free, free, 1.0 / scale);
      append(t, op.strain_stiffness, free, free, 1.0 / scale);
    }
    matrix.resize(free + strains, free + strains);
    matrix.setFromTriplets(t.begin(), t.end());
  }

  void factorise() {
    SparseMatrix regular = matrix;
    for (Eigen::Index d = 0; d < free; ++d) regular.coeffRef(d, d) += kRegularisation;
    regular.makeCompressed();
    if (op.symmetric) {
      ldlt.compute(regular);
    } else {
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
  Eigen::VectorXd rhs = load_of(affine_force);
  if (op.deformable()) rhs.tail(op.stress.rows()) = op.stress * affine_force / scale;

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
  Eigen::VectorXd rhs = m.load_of(force);
  if (m.op.deformable()) {
    rhs.tail(m.op.stress.rows()) = (m.op.stress * force - rates.strain_stiffness * state.strain) / m.scale;
  }
  StaticState change = m.unpack(m.refined_solution(rhs, kResidual * (rhs.norm() + state.bond_forces.norm() / m.scale)));
  change.bond_forces = force + m.op.stiffness.cwiseProduct(m.overlaps_of(change));
  return change;
}

}  // namespace ddem
