#include "dem/statics/static_solver.h"

#include <optional>
#include <stdexcept>

#include "dem/statics/bond_system.h"
#include "dem/statics/front_factors.h"

namespace ddem {
namespace {

constexpr double kRegularisation = 1e-11;
// Factors of many discs are single, which takes half of the memory and time: refinement takes a few rounds more. The regularisation is
// above the round-off of float, so that pivots stay positive. Where they do not, or refinement does not end, double ones are made.
constexpr double kSingleRegularisation = 1e-6;
constexpr double kResidual = 1e-12;
constexpr int kRefinements = 20;

/// Unknowns and forces, a column for each load.
struct Balance {
  Eigen::MatrixXd x, forces;
};

/// Of the precision that does.
class Factors {
 public:
  Factors(const BondSystem& system, EliminationTree tree) : tree_(std::make_shared<const EliminationTree>(std::move(tree))) {
    if (system.place.size() > static_cast<std::size_t>(kManyDiscs)) {
      try {
        single_.emplace(system, tree_, kSingleRegularisation);
        return;
      } catch (const std::runtime_error&) {  // a pivot that round-off took away
      }
    }
    double_.emplace(system, tree_, kRegularisation);
  }

  /// A^-1 of each column, about.
  void solve(Eigen::MatrixXd& columns) const {
    if (double_) return double_->solve(columns);
    // Residuals become small: in units of their largest nothing leaves the range of float.
    const Eigen::ArrayXXd unit = columns.cwiseAbs().colwise().maxCoeff();
    Eigen::MatrixXf rounded = (columns.array() / unit.replicate(columns.rows(), 1)).cast<float>();
    single_->solve(rounded);
    columns = rounded.cast<double>().array() * unit.replicate(columns.rows(), 1);
  }

  /// Whether there is a better precision, which is then taken.
  bool improve(const BondSystem& system) {
    if (double_) return false;
    single_.reset();  // both are large
    double_.emplace(system, tree_, kRegularisation);
    return true;
  }

 private:
  std::shared_ptr<const EliminationTree> tree_;
  std::optional<FrontFactors<float>> single_;
  std::optional<FrontFactors<double>> double_;
};

}  // namespace

/// Forces, stiffnesses and loads are divided by the scale, the unknowns of a disc together, in the order of elimination
/// (bond_system.h).
struct StaticSolver::Impl {
  const Assembly& assembly;
  OperatorFrame op;
  double scale;
  BondSystem system;
  std::unique_ptr<Factors> factors;

  Impl(const Assembly& a, const ContactParameters& contact, const DeformationParameters& deformation, const HeldDofs& held)
      : Impl(a, operator_frame(a, contact, deformation), deformation, held, elimination_tree(a.packing, a.bonds)) {}
  Impl(const Assembly& a, OperatorFrame operators, const DeformationParameters& deformation, const HeldDofs& held, EliminationTree tree)
      : assembly(a),
        op(std::move(operators)),
        scale(op.stiffness.size() > 0 ? op.stiffness.maxCoeff() : 1.0),
        system(bond_system(a, op, deformation, held, tree, scale)),
        factors(std::make_unique<Factors>(system, std::move(tree))) {}

  /// x and F with F = K (overlaps + r x) and l^T F + D x = loads.
  Balance balanced(const Eigen::MatrixXd& overlaps, const Eigen::MatrixXd& loads) const {
    do {  // with other factors from the beginning: nothing is left of what did not converge
      if (std::optional<Balance> b = refined(overlaps, loads)) return *std::move(b);
    } while (factors->improve(system));
    throw std::runtime_error("the static solve did not converge: the assembly has a mechanism that the load drives");
  }

  /// The same, or nothing where refinement does not end.
  std::optional<Balance> refined(const Eigen::MatrixXd& overlaps, const Eigen::MatrixXd& loads) const {
    Balance b{Eigen::MatrixXd::Zero(system.size(), overlaps.cols()), system.stiffness.asDiagonal() * overlaps};
    Eigen::MatrixXd load = loads, change;
    for (Eigen::Index c = 0; c < load.cols(); ++c) load.col(c) -= system.loads(b.forces.col(c));
    for (int k = 0; k <= kRefinements; ++k) {
      std::vector<Eigen::Index> columns;
      for (Eigen::Index c = 0; c < load.cols(); ++c) {
        if (!(load.col(c).norm() <= kResidual * b.forces.col(c).norm())) columns.push_back(c);
      }
      if (columns.empty()) return b;
      change = load(Eigen::all, columns);
      factors->solve(change);
      for (std::size_t n = 0; n < columns.size(); ++n) {
        const Eigen::Index c = columns[n];
        b.x.col(c) += change.col(static_cast<Eigen::Index>(n));
        b.forces.col(c) += system.stiffness.cwiseProduct(system.overlaps(change.col(static_cast<Eigen::Index>(n))));
        load.col(c) = loads.col(c) - system.balance(b.forces.col(c), b.x.col(c));
      }
    }
    return std::nullopt;
  }

  std::vector<StaticState> states(const Balance& b) const {
    std::vector<StaticState> states;
    for (Eigen::Index c = 0; c < b.x.cols(); ++c) {
      StaticState& state = states.emplace_back();
      state.bond_forces = scale * b.forces.col(c);
      state.fluctuation.resize(op.dofs_per_disc * static_cast<Eigen::Index>(assembly.size()));
      for (int p = 0; p < static_cast<int>(assembly.size()); ++p) {
        state.fluctuation.segment(static_cast<Eigen::Index>(op.dofs_per_disc) * p, op.dofs_per_disc) =
            b.x.col(c).segment(system.at(p), op.dofs_per_disc);
      }
    }
    return states;
  }

  std::vector<StaticState> under(const Eigen::MatrixXd& affine) const {
    return states(balanced(affine, Eigen::MatrixXd::Zero(system.size(), affine.cols())));
  }
};

Eigen::Vector2d bond_force(const Bonds& b, const OperatorFrame& op, const StaticState& state, std::size_t c) {
  const double fn = state.bond_forces[op.rows_per_bond * c];
  const double ft = op.rows_per_bond == 2 ? state.bond_forces[2 * c + 1] : 0.0;
  return {fn * b.nx[c] - ft * b.ny[c], fn * b.ny[c] + ft * b.nx[c]};
}

StaticSolver::StaticSolver(const Assembly& assembly, const ContactParameters& contact,
                           const DeformationParameters& deformation, const HeldDofs& held)
    : impl_(std::make_unique<Impl>(assembly, contact, deformation, held)) {}

StaticSolver::~StaticSolver() = default;
StaticSolver::StaticSolver(StaticSolver&&) noexcept = default;

const OperatorFrame& StaticSolver::operators() const { return impl_->op; }

StaticState StaticSolver::solve(const MacroStrain& strain) const { return solve(std::span(&strain, 1)).front(); }

std::vector<StaticState> StaticSolver::solve(std::span<const MacroStrain> strains) const {
  Eigen::MatrixXd affine(impl_->op.stiffness.size(), static_cast<Eigen::Index>(strains.size()));
  for (Eigen::Index k = 0; k < affine.cols(); ++k) affine.col(k) = affine_overlaps(impl_->assembly, impl_->op, strains[k]);
  return impl_->under(affine);
}

StaticState StaticSolver::solve_moved(const Eigen::VectorXd& displacement) const {
  StaticState state = impl_->under(rigid_overlaps(impl_->assembly, impl_->op, displacement)).front();
  state.fluctuation += displacement;
  return state;
}

StaticState StaticSolver::rate(const StaticState& state, const OperatorRates& rates) const {
  const Impl& m = *impl_;
  const Eigen::VectorXd force = state.bond_forces / m.scale;
  const Eigen::VectorXd stretch = rates.stiffness.cwiseQuotient(m.op.stiffness).cwiseProduct(force.cwiseQuotient(m.system.stiffness));
  Eigen::VectorXd load = Eigen::VectorXd::Zero(m.system.size());
  const Eigen::VectorXd on_discs = m.system.loads(force);
  for (int p = 0; p < static_cast<int>(m.assembly.size()); ++p) {
    for (int k = 0; k < m.system.strains; ++k) {
      const Eigen::Index at = m.system.at(p) + m.op.dofs_per_disc + k;
      load[at] = -rates.compliance[static_cast<std::size_t>(k)] * on_discs[at];
    }
  }
  return m.states(m.balanced(stretch, load)).front();
}

}  // namespace ddem
