#include "dem/statics/static_solver.h"

#include <stdexcept>
#include <variant>

#include "dem/statics/bond_system.h"
#include "dem/statics/front_factors.h"

namespace ddem {
namespace {

constexpr double kRegularisation = 1e-11;
// Of more discs the factors are single, which takes half of the memory and time: refinement takes a few rounds more. With a
// regularisation above the round-off of float their pivots stay positive.
constexpr std::size_t kManyDiscs = 20000;
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
  Factors(const BondSystem& system, EliminationTree tree) : factors_(made(system, std::move(tree))) {}

  /// A^-1 of each column, about.
  void solve(Eigen::MatrixXd& columns) const {
    const auto* single = std::get_if<FrontFactors<float>>(&factors_);
    if (single == nullptr) return std::get<FrontFactors<double>>(factors_).solve(columns);
    // Residuals become small: in units of their largest nothing leaves the range of float.
    const Eigen::ArrayXXd unit = columns.cwiseAbs().colwise().maxCoeff();
    Eigen::MatrixXf rounded = (columns.array() / unit.replicate(columns.rows(), 1)).cast<float>();
    single->solve(rounded);
    columns = rounded.cast<double>().array() * unit.replicate(columns.rows(), 1);
  }

  /// Whether there is a better precision, which is then taken.
  bool improve(const BondSystem& system) {
    const auto* single = std::get_if<FrontFactors<float>>(&factors_);
    if (single == nullptr) return false;
    EliminationTree tree = single->tree();
    factors_.emplace<FrontFactors<double>>(system, std::move(tree), kRegularisation);  // what is there goes before: both are large
    return true;
  }

 private:
  using Either = std::variant<FrontFactors<double>, FrontFactors<float>>;

  static Either made(const BondSystem& system, EliminationTree tree) {
    if (system.place.size() <= kManyDiscs) return FrontFactors<double>(system, std::move(tree), kRegularisation);
    return FrontFactors<float>(system, std::move(tree), kSingleRegularisation);
  }

  Either factors_;
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
  Balance balanced(Eigen::MatrixXd overlaps, const Eigen::MatrixXd& loads) const {
    Balance b{Eigen::MatrixXd::Zero(system.size(), overlaps.cols()), std::move(overlaps)};
    b.forces.array().colwise() *= system.stiffness.array();
    Eigen::MatrixXd load = loads, change;
    for (Eigen::Index c = 0; c < load.cols(); ++c) load.col(c) -= system.loads(b.forces.col(c));
    for (int rounds = 0;; ++rounds) {
      std::vector<Eigen::Index> columns;
      for (Eigen::Index c = 0; c < load.cols(); ++c) {
        if (!(load.col(c).norm() <= kResidual * b.forces.col(c).norm())) columns.push_back(c);
      }
      if (columns.empty()) return b;
      if (rounds > kRefinements) {
        if (!factors->improve(system)) throw std::runtime_error("the static solve did not converge: the assembly has a mechanism that the load drives");
        rounds = 0;
      }
      change = load(Eigen::all, columns);
      factors->solve(change);
      for (std::size_t n = 0; n < columns.size(); ++n) {
        const Eigen::Index c = columns[n];
        b.x.col(c) += change.col(static_cast<Eigen::Index>(n));
        b.forces.col(c) += system.stiffness.cwiseProduct(system.overlaps(change.col(static_cast<Eigen::Index>(n))));
        load.col(c) = loads.col(c) - system.balance(b.forces.col(c), b.x.col(c));
      }
    }
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

  std::vector<StaticState> under(Eigen::MatrixXd affine) const {
    const Eigen::Index loads = affine.cols();
    return states(balanced(std::move(affine), Eigen::MatrixXd::Zero(system.size(), loads)));
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
  return impl_->under(std::move(affine));
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
