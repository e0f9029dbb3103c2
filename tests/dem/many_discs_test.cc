// Statics of many discs: another order of elimination, subtrees in threads, and factors in single precision.

#include <gtest/gtest.h>

#include <limits>

#include "dem/statics/bond_system.h"
#include "dem/statics/front_factors.h"
#include "dem/statics/moduli.h"
#include "meshes/packings/tile.h"
#include "tests/support/assemblies.h"
#include "tests/support/one_core.h"

namespace ddem {
namespace {

constexpr ContactParameters kContact{1e10, 0.25, Kinematics::linear};

Packing cell_packing() { return test::oracle_packing("packings/p682_s1.csv", {16.5e-3, 2e-3}, 16.5e-3, 2e-3); }

Assembly copies(int nx, int ny) {
  const Packing cell = cell_packing(), many = packings::tile(cell, nx, ny);
  return make_assembly(many, bonds_within_gap(many, 0.3 * mean_radius(cell)), 1.0, test::kDensity);
}

struct Equations {
  Assembly assembly;
  EliminationTree tree;
  BondSystem system;

  explicit Equations(Assembly a)
      : assembly(std::move(a)), tree(elimination_tree(assembly.packing, assembly.bonds)),
        system(bond_system(assembly, operator_frame(assembly, kContact, {}), {}, {}, tree, kContact.normal_stiffness)) {}

  Eigen::MatrixXd columns() const {
    return Eigen::MatrixXd::NullaryExpr(system.size(), 2, [](Eigen::Index r, Eigen::Index c) { return std::sin(0.7 * static_cast<double>(r) + static_cast<double>(c)); });
  }
};

constexpr double kRegularisation = 1e-3;

/// |A x - b| over |A| |x|, A with its regularisation.
template <class Real>
double backward_error(const Equations& e) {
  const Eigen::MatrixXd b = e.columns();
  typename FrontFactors<Real>::Columns x = b.cast<Real>();
  FrontFactors<Real>(e.system, std::make_shared<const EliminationTree>(e.tree), kRegularisation).solve(x);
  double worst = 0.0;
  for (Eigen::Index c = 0; c < b.cols(); ++c) {
    const Eigen::VectorXd solution = x.col(c).template cast<double>();
    const Eigen::VectorXd product = e.system.balance(e.system.stiffness.cwiseProduct(e.system.overlaps(solution)), solution) + kRegularisation * solution;
    worst = std::max(worst, (product - b.col(c)).cwiseAbs().maxCoeff() / solution.cwiseAbs().maxCoeff());
  }
  return worst / 10.0;  // a disc has six bonds
}

// 20460 discs are more than minimum degree orders, and make subtrees.
TEST(ManyDiscs, BothPrecisionsSolveToTheirRoundOff) {
  const Equations e(copies(2, 15));
  ASSERT_GT(subtrees_of(e.tree).ranges.size(), 5u);
  EXPECT_LT(backward_error<double>(e), 100.0 * std::numeric_limits<double>::epsilon());
  EXPECT_LT(backward_error<float>(e), 100.0 * std::numeric_limits<float>::epsilon());
}

TEST(ManyDiscs, SameBitsOnOneCore) {
  const Equations e(copies(2, 15));
  Eigen::MatrixXd many = e.columns(), one = many;
  FrontFactors<double>(e.system, std::make_shared<const EliminationTree>(e.tree), kRegularisation).solve(many);
  const test::OneCore core;
  FrontFactors<double>(e.system, std::make_shared<const EliminationTree>(e.tree), kRegularisation).solve(one);
  EXPECT_EQ(many, one);
}

/// Every front is in one range or at the top, and what a range leaves over is that of its last front.
TEST(ManyDiscs, SubtreesAreApart) {
  const Equations e(copies(2, 15));
  const Subtrees s = subtrees_of(e.tree);
  std::vector<int> seen(e.tree.fronts.size(), 0);
  for (const Subtrees::Range& r : s.ranges) {
    for (int f = r.begin; f < r.end; ++f) {
      ++seen[f];
      for (const int child : e.tree.fronts[f].children) EXPECT_TRUE(child >= r.begin && child < f);
    }
    for (int f = r.begin; f + 1 < r.end; ++f) EXPECT_LT(e.tree.fronts[f].rest.empty() ? 0 : e.tree.fronts[f].rest.front(), e.tree.fronts[r.end - 1].end);
  }
  for (const int f : s.top) ++seen[f];
  EXPECT_TRUE(std::ranges::all_of(seen, [](int n) { return n == 1; }));
}

// A periodic cell and any number of its copies are the same solid. 20460 discs are factorised in single precision; of those that
// hardly resist rotation refinement does not end, and they are factorised again.
TEST(ManyDiscs, CopiesOfACellHaveItsModuli) {
  const Assembly many = copies(2, 15), cell = copies(1, 1);
  for (const double ratio : {0.0, 0.25, 1e-7}) {
    const ContactParameters contact{1e10, ratio, Kinematics::linear};
    const PlaneStiffness expected = homogenise_cell(cell, contact, {});
    EXPECT_LT((homogenise_cell(many, contact, {}) - expected).norm(), 1e-10 * expected.norm()) << ratio;
  }
  DeformationParameters soft;
  soft.scheme = Scheme::implicit;
  soft.young_modulus = 4e10;
  soft.poisson_ratio = 0.3;
  for (const Correction correction : {Correction::full, Correction::normal}) {  // symmetric, and not
    soft.correction = correction;
    const PlaneStiffness expected = homogenise_cell(cell, kContact, soft);
    EXPECT_LT((homogenise_cell(many, kContact, soft) - expected).norm(), 1e-10 * expected.norm());
  }
}

}  // namespace
}  // namespace ddem
