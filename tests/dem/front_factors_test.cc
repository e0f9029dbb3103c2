// The equations of statics and their sparse factors, against the assembly's operators and dense matrices.
#include "dem/statics/front_factors.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <limits>
#include <random>
#include <set>

#include "tests/support/assemblies.h"

namespace ddem {
namespace {

constexpr double kStiffness = 1e10;
constexpr double kRoundOff = std::numeric_limits<double>::epsilon();

struct StrainLaw {
  Scheme scheme;
  Correction correction;
  double stiffness_ratio;
};

const StrainLaw kLaws[] = {{Scheme::none, Correction::normal, 0.0},     {Scheme::none, Correction::normal, 0.4},
                           {Scheme::implicit, Correction::full, 0.0},   {Scheme::implicit, Correction::full, 0.4},
                           {Scheme::implicit, Correction::normal, 0.4}, {Scheme::implicit, Correction::normal_only_stress, 0.4}};

/// The left end of a random packing, periodic in y: some hundred discs.
Assembly random_piece() {
  Packing p = test::oracle_packing("packings/p682_s1.csv", {16.5e-3, 2e-3}, 2.4e-3, 2e-3);
  std::size_t kept = 0;
  for (std::size_t d = 0; d < p.size(); ++d) {
    if (p.x[d] > 2.4e-3) continue;
    p.x[kept] = p.x[d], p.y[kept] = p.y[d], p.radius[kept] = p.radius[d];
    ++kept;
  }
  for (auto* v : {&p.x, &p.y, &p.radius}) v->resize(kept);
  p.period = {0.0, 2e-3};
  return make_assembly(p, bonds_within_gap(p, 0.3 * mean_radius(p)), 1.0, test::kDensity);
}

/// All of the matter of a law in one place; the discs of the left end held, by rotation too.
struct Problem {
  Assembly assembly;
  Operators op;
  HeldDofs held;
  EliminationTree tree;
  BondSystem system;

  Problem(Assembly a, const StrainLaw& law) : assembly(std::move(a)) {
    DeformationParameters d;
    d.scheme = law.scheme;
    d.correction = law.correction;
    d.young_modulus = kStiffness / 0.3;
    d.poisson_ratio = 0.25;
    op = make_operators(assembly, {kStiffness, law.stiffness_ratio, Kinematics::linear}, d);
    held.x.assign(assembly.size(), 0);
    for (const int p : edge_discs(assembly.packing, Edge::left, 3.0 * mean_radius(assembly.packing))) held.x[p] = 1;
    held.y = held.theta = held.x;
    tree = elimination_tree(assembly.packing, assembly.bonds);
    system = bond_system(assembly, op, d, held, tree, kStiffness);
  }

  /// Where an unknown of q or of the strains stands in the system.
  std::vector<int> rows_of_displacements() const {
    std::vector<int> rows;
    for (int d = 0; d < op.overlap.cols(); ++d) rows.push_back(static_cast<int>(system.at(d / op.dofs_per_disc)) + d % op.dofs_per_disc);
    return rows;
  }
  std::vector<int> rows_of_strains() const {
    std::vector<int> rows;
    for (int d = 0; d < op.stress.rows(); ++d) rows.push_back(static_cast<int>(system.at(d / 3)) + op.dofs_per_disc + d % 3);
    return rows;
  }

  /// [C^T; -S] K [C, -G] + V C over k_n, from the operators; strains as T times the unknowns: area, two shears, and each so
  /// large that its V C and k_n add up to k_n.
  Eigen::MatrixXd dense() const {
    const Eigen::Index q = op.overlap.cols(), eps = op.stress.rows();
    Eigen::MatrixXd right(op.overlap.rows(), q + eps), left(q + eps, op.overlap.rows()), strain_stiffness;
    right.leftCols(q) = op.overlap;
    left.topRows(q) = right.leftCols(q).transpose();
    if (op.deformable) {
      Eigen::MatrixXd t = Eigen::MatrixXd::Zero(eps, eps);
      for (Eigen::Index d = 0; d < eps; d += 3) t.block<3, 3>(d, d) << 1.0, 1.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, 1.0;
      t /= std::sqrt(2.0);
      strain_stiffness = t.transpose() * op.strain_stiffness * t;
      const Eigen::VectorXd unit = (strain_stiffness.diagonal().array() / kStiffness + 1.0).rsqrt();
      t = t * unit.asDiagonal();
      strain_stiffness = unit.asDiagonal() * strain_stiffness * unit.asDiagonal();
      right.rightCols(eps) = -(op.strain_overlap * t);
      left.bottomRows(eps) = -(t.transpose() * op.stress);
    }
    Eigen::MatrixXd a = left * op.stiffness.asDiagonal() * right;
    if (op.deformable) a.bottomRightCorner(eps, eps) += strain_stiffness;
    std::vector<int> to = rows_of_displacements();
    for (const int r : rows_of_strains()) to.push_back(r);
    Eigen::MatrixXd ordered = Eigen::MatrixXd::Zero(system.size(), system.size());
    ordered(to, to) = a / kStiffness;
    for (Eigen::Index k = 0; k < system.size(); ++k) {
      if (!system.held[k]) continue;
      ordered.row(k).setZero();
      ordered.col(k).setZero();
      ordered(k, k) = 1.0;
    }
    return ordered;
  }
};

Eigen::MatrixXd random_columns(Eigen::Index rows, Eigen::Index columns) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return any(generator); });
}

/// As large as the matrix is anywhere in a test, it is at most this far from a rounded one: sums of some ten terms.
constexpr double kOfSums = 100.0 * kRoundOff;

TEST(BondSystem, IsTheOperators) {
  for (const StrainLaw& law : kLaws) {
    const Problem p(random_piece(), law);
    const Eigen::MatrixXd dense = p.dense(), x = random_columns(p.system.size(), 1);
    const Eigen::VectorXd product = p.system.balance(p.system.stiffness.cwiseProduct(p.system.overlaps(x)), x);
    EXPECT_LT((product - dense * x).cwiseAbs().maxCoeff(), kOfSums * dense.cwiseAbs().maxCoeff());
  }
}

TEST(OperatorFrame, BondByBondIsTheMatrixToTheBit) {
  for (const StrainLaw& law : kLaws) {
    const Problem p(random_piece(), law);
    const Eigen::VectorXd q = random_columns(p.op.overlap.cols(), 1);
    EXPECT_EQ(rigid_overlaps(p.assembly, p.op, q), Eigen::VectorXd(p.op.overlap * q));
  }
}

/// Backward stable: the residual is round-off of the matrix times the solution, whatever the condition. A held strip has no
/// motion without stiffness but rattling discs and rotations; the regularisation is that of the matrix.
TEST(FrontFactors, SolveTheDenseSystem) {
  constexpr double regularisation = 1e-3;
  for (const StrainLaw& law : kLaws) {
    const Problem p(random_piece(), law);
    Eigen::MatrixXd dense = p.dense();
    for (const int d : p.rows_of_displacements()) {
      if (!p.system.held[d]) dense(d, d) += regularisation;
    }
    const Eigen::MatrixXd b = random_columns(p.system.size(), 3);
    Eigen::MatrixXd x = b;
    FrontFactors<double>(p.system, std::make_shared<const EliminationTree>(p.tree), regularisation).solve(x);
    const double size = static_cast<double>(p.system.size());
    EXPECT_LT((dense * x - b).cwiseAbs().maxCoeff(), size * kRoundOff * dense.cwiseAbs().maxCoeff() * x.cwiseAbs().maxCoeff());

    Eigen::MatrixXd alone = b.col(1);
    FrontFactors<double>(p.system, std::make_shared<const EliminationTree>(p.tree), regularisation).solve(alone);
    EXPECT_EQ(alone.col(0), x.col(1)) << "a column depends on those beside it";
  }
}

TEST(FrontFactors, AVanishingPivotIsAnError) {
  Problem p(random_piece(), kLaws[0]);
  p.system.stiffness.setZero();
  EXPECT_THROW(FrontFactors<double>(p.system, std::make_shared<const EliminationTree>(p.tree), 0.0), std::runtime_error);
}

/// Each bond joins discs of one front, or of a front and its rest; what a front has left over has room in the front that takes it.
TEST(EliminationTree, HasRoomForEveryCoupling) {
  const Assembly a = test::random_free_strip();
  const EliminationTree tree = elimination_tree(a.packing, a.bonds);
  EXPECT_EQ(std::set<int>(tree.place.begin(), tree.place.end()).size(), a.size());
  EXPECT_EQ(tree.fronts.back().end, static_cast<int>(a.size()));
  const auto has = [&](int front, int place) {
    const Front& f = tree.fronts[front];
    return (place >= f.begin && place < f.end) || std::binary_search(f.rest.begin(), f.rest.end(), place);
  };
  for (std::size_t c = 0; c < a.bonds.size(); ++c) {
    const int i = tree.place[a.bonds.i[c]], j = tree.place[a.bonds.j[c]];
    EXPECT_TRUE(has(tree.front_of[std::min(i, j)], std::max(i, j)));
  }
  std::set<int> taken;
  for (int f = 0; f < static_cast<int>(tree.fronts.size()); ++f) {
    for (const int child : tree.fronts[f].children) {
      EXPECT_LT(child, f);
      EXPECT_TRUE(taken.insert(child).second);
      for (const int place : tree.fronts[child].rest) EXPECT_TRUE(has(f, place));
    }
  }
}

std::vector<double> eliminated(InstructionSet isa, bool symmetric) {
  constexpr int own = 21, rest = 13;
  DenseFront<double> f{.own = own, .rest = rest, .stride = 40, .rest_stride = 16, .symmetric = symmetric};
  Eigen::MatrixXd a = random_columns(own + rest, own + rest);
  if (symmetric) a = (a + a.transpose()).eval();
  a.diagonal().array() += own + rest;
  Eigen::MatrixXd lower = Eigen::MatrixXd::Zero(f.stride, own), upper = lower, schur = Eigen::MatrixXd::Zero(f.rest_stride, rest);
  lower.topRows(own + rest) = a.leftCols(own);
  upper.topRows(own + rest) = a.topRows(own).transpose();
  schur.topRows(rest) = a.bottomRightCorner(rest, rest);
  Eigen::VectorXd pivots(own);
  f.lower = lower.data(), f.upper = upper.data(), f.schur = schur.data(), f.inverse_pivot = pivots.data();
  const FrontKernels<double> kernels = front_kernels<double>(isa);
  EXPECT_TRUE(kernels.eliminate(f));
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(f.stride, 2);
  x.topRows(own + rest) = random_columns(own + rest, 2);
  kernels.forward(f, {x.data(), f.stride, 2});
  kernels.backward(f, {x.data(), f.stride, 2});

  const Eigen::MatrixXd answer = a.topLeftCorner(own, own).inverse() * a.topRightCorner(own, rest);
  const Eigen::MatrixXd left_over = a.bottomRightCorner(rest, rest) - a.bottomLeftCorner(rest, own) * answer;
  for (int c = 0; c < rest; ++c) {
    for (int r = symmetric ? c : 0; r < rest; ++r) EXPECT_NEAR(schur(r, c), left_over(r, c), kOfSums * a.norm());
  }
  std::vector<double> bits(x.data(), x.data() + x.size());
  bits.insert(bits.end(), lower.data() + own, lower.data() + lower.rows());
  return bits;
}

/// The diagonal dominates, so that nothing grows: the errors are sums of round-off.
TEST(FrontKernels, SameBitsWithEveryInstructionSet) {
  for (const bool symmetric : {true, false}) {
    const std::vector<double> best = eliminated(best_instruction_set(), symmetric);
    EXPECT_EQ(eliminated(InstructionSet::baseline, symmetric), best);
    if (best_instruction_set() == InstructionSet::avx512) {
      EXPECT_EQ(eliminated(InstructionSet::avx2, symmetric), best);
    }
  }
}

}  // namespace
}  // namespace ddem
