#include "dem/statics/static_solver.h"

#include <stdexcept>

#include "dem/statics/bond_system.h"
#include "dem/statics/front_factors.h"

namespace ddem {
namespace {

constexpr double kRegularisation = 1e-11;
constexpr double kResidual = 1e-12;
constexpr int kRefinements = 20;

}  // namespace

/// Unknowns and loads are divided by the scale, those of a disc together, in the order of elimination (bond_system.h).
struct StaticSolver::Impl {
  const Assembly& assembly;
  Operators op;
  double scale;
  BondSystem system;
  FrontFactors factors;

  Impl(const Assembly& a, const ContactParameters& contact, const DeformationParameters& deformation, const HeldDofs& held)
      : Impl(a, make_operators(a, contact, deformation), deformation, held, elimination_tree(static_cast<int>(a.size()), a.bonds)) {}
  Impl(const Assembly& a, Operators operators, const DeformationParameters& deformation, const HeldDofs& held, EliminationTree tree)
      : assembly(a),
        op(std::move(operators)),
        scale(op.stiffness.size() > 0 ? op.stiffness.maxCoeff() : 1.0),
        system(bond_system(a, op, deformation, held, tree, scale)),
        factors(system, std::move(tree), kRegularisation) {}

  /// Fluctuation, strains and forces that balance the overlaps of an affine or imposed motion, a column each.
  std::vector<StaticState> balance(const Eigen::MatrixXd& affine) const;

  /// A^-1 of each right-hand side, right to a residual of its own.
  Eigen::MatrixXd refined_solution(const Eigen::MatrixXd& rhs, const Eigen::VectorXd& target) const {
    Eigen::MatrixXd x = Eigen::MatrixXd::Zero(rhs.rows(), rhs.cols()), residual = rhs, correction;
    const auto open = [&](Eigen::Index c) { return !(residual.col(c).norm() <= target[c]); };
    for (int k = 0; k <= kRefinements; ++k) {
      std::vector<Eigen::Index> columns;
      for (Eigen::Index c = 0; c < rhs.cols(); ++c) {
        if (open(c)) columns.push_back(c);
      }
      if (columns.empty()) return x;
      correction = residual(Eigen::all, columns);
      factors.solve(correction);
      for (std::size_t c = 0; c < columns.size(); ++c) {
        x.col(columns[c]) += correction.col(static_cast<Eigen::Index>(c));
        residual.col(columns[c]) = rhs.col(columns[c]) - system.product(x.col(columns[c]));
      }
    }
    throw std::runtime_error("the static solve did not converge: the assembly has a mechanism that the load drives");
  }

  /// Fluctuation and strains of a solution; no forces yet.
  StaticState unpack(const Eigen::VectorXd& x) const {
    StaticState state;
    state.fluctuation.resize(op.overlap.cols());
    if (op.deformable()) state.strain.resize(op.stress.rows());
    for (int p = 0; p < static_cast<int>(assembly.size()); ++p) {
      const Eigen::Index at = system.at(p);
      state.fluctuation.segment(static_cast<Eigen::Index>(op.dofs_per_disc) * p, op.dofs_per_disc) = x.segment(at, op.dofs_per_disc);
      if (op.deformable()) state.strain.segment<3>(3 * static_cast<Eigen::Index>(p)) = x.segment<3>(at + op.dofs_per_disc);
    }
    return state;
  }
};

Eigen::Vector2d bond_force(const Bonds& b, const Operators& op, const StaticState& state, std::size_t c) {
  const double fn = state.bond_forces[op.rows_per_bond * c];
  const double ft = op.rows_per_bond == 2 ? state.bond_forces[2 * c + 1] : 0.0;
  return {fn * b.nx[c] - ft * b.ny[c], fn * b.ny[c] + ft * b.nx[c]};
}

StaticSolver::StaticSolver(const Assembly& assembly, const ContactParameters& contact,
                           const DeformationParameters& deformation, const HeldDofs& held)
    : impl_(std::make_unique<Impl>(assembly, contact, deformation, held)) {}

StaticSolver::~StaticSolver() = default;
StaticSolver::StaticSolver(StaticSolver&&) noexcept = default;

const Operators& StaticSolver::operators() const { return impl_->op; }

StaticState StaticSolver::solve(const MacroStrain& strain) const { return solve(std::span(&strain, 1)).front(); }

std::vector<StaticState> StaticSolver::solve(std::span<const MacroStrain> strains) const {
  Eigen::MatrixXd affine(impl_->op.stiffness.size(), static_cast<Eigen::Index>(strains.size()));
  for (Eigen::Index k = 0; k < affine.cols(); ++k) affine.col(k) = affine_overlaps(impl_->assembly, impl_->op, strains[k]);
  return impl_->balance(affine);
}

StaticState StaticSolver::solve_moved(const Eigen::VectorXd& displacement) const {
  StaticState state = impl_->balance(impl_->op.overlap * displacement).front();
  state.fluctuation += displacement;
  return state;
}

std::vector<StaticState> StaticSolver::Impl::balance(const Eigen::MatrixXd& affine) const {
  Eigen::MatrixXd rhs(system.size(), affine.cols());
  for (Eigen::Index k = 0; k < rhs.cols(); ++k) rhs.col(k) = -system.loads(system.stiffness.cwiseProduct(affine.col(k)));

  // Relative to the affine forces, not to the right-hand side: that one vanishes on a perfect lattice.
  const Eigen::MatrixXd x = refined_solution(rhs, kResidual * affine.colwise().norm());

  std::vector<StaticState> states;
  for (Eigen::Index k = 0; k < rhs.cols(); ++k) {
    states.push_back(unpack(x.col(k)));
    states.back().bond_forces = op.stiffness.cwiseProduct(affine.col(k) + system.overlaps(x.col(k)));
  }
  return states;
}

StaticState StaticSolver::rate(const StaticState& state, const OperatorRates& rates) const {
  const Impl& m = *impl_;
  const Eigen::VectorXd overlaps = state.bond_forces.cwiseQuotient(m.op.stiffness);
  const Eigen::VectorXd force = rates.stiffness.cwiseProduct(overlaps);
  Eigen::VectorXd rhs = -m.system.loads(force) / m.scale;
  if (m.op.deformable()) {
    const Eigen::VectorXd lacking = rates.strain_stiffness * state.strain / m.scale;
    for (int p = 0; p < static_cast<int>(m.assembly.size()); ++p) {
      rhs.segment<3>(m.system.at(p) + m.op.dofs_per_disc) -= lacking.segment<3>(3 * static_cast<Eigen::Index>(p));
    }
  }
  const Eigen::VectorXd target = Eigen::VectorXd::Constant(1, kResidual * (rhs.norm() + state.bond_forces.norm() / m.scale));
  const Eigen::VectorXd x = m.refined_solution(rhs, target);
  StaticState change = m.unpack(x);
  change.bond_forces = force + m.op.stiffness.cwiseProduct(m.system.overlaps(x));
  return change;
}

}  // namespace ddem
