// Static moduli of six random periodic packings against an independent program's table (tests/oracles/packings).

#include <gtest/gtest.h>

#include <cmath>

#include "dem/assembly/contacts.h"
#include "dem/statics/moduli.h"
#include "tests/support/oracle_files.h"

namespace ddem {
namespace {

constexpr double kNormalStiffness = 1e10;

struct TableRow {
  int seed;
  int bonds;
  double gap, coordination, bulk_density;
  ContactParameters contact;
  DeformationParameters deformation;
  double young, shear, bulk, poisson;
};

TableRow parse(const test::Row& r) {
  TableRow t;
  t.seed = std::stoi(r[0]);
  t.gap = std::stod(r[1]);
  t.bonds = std::stoi(r[2]);
  t.coordination = std::stod(r[3]);
  t.bulk_density = std::stod(r[4]);
  t.contact.normal_stiffness = kNormalStiffness;
  t.contact.stiffness_ratio = std::stod(r[6]);
  if (r[5] != "none") {
    t.deformation.scheme = Scheme::lagged;
    t.deformation.correction = r[5] == "full" ? Correction::full : Correction::normal;
    t.deformation.young_modulus = kNormalStiffness / std::stod(r[7]);
    t.deformation.poisson_ratio = std::stod(r[8]);
  }
  t.young = std::stod(r[9]);
  t.shear = std::stod(r[10]);
  t.bulk = std::stod(r[11]);
  t.poisson = std::stod(r[12]);
  return t;
}

Assembly assembly_of(const TableRow& t) {
  const Packing p = test::oracle_packing("packings/p682_s" + std::to_string(t.seed) + ".csv", {16.5e-3, 2e-3}, 16.5e-3, 2e-3);
  return make_assembly(p, bonds_within_gap(p, t.gap * mean_radius(p)), 1.0, 2000.0);
}

double largest_error(const TableRow& t, const DeformationParameters& deformation) {
  const Assembly a = assembly_of(t);
  const IsotropicModuli m = isotropic_part(homogenise_cell(a, t.contact, deformation));
  const double k = kNormalStiffness;
  return std::max({std::abs(m.young() / k - t.young), std::abs(m.shear / k - t.shear), std::abs(m.bulk / k - t.bulk),
                   std::abs(m.poisson() - t.poisson)});
}

TEST(OracleModuli, WholeTable) {
  const auto rows = test::oracle_rows("packings/moduli_periodic_xy.csv");
  ASSERT_GT(rows.size(), 50u);
  for (const auto& row : rows) {
    const TableRow t = parse(row);
    const Assembly a = assembly_of(t);
    EXPECT_EQ(static_cast<int>(a.bonds.size()), t.bonds);
    EXPECT_NEAR(bulk_density(a), t.bulk_density, 1e-3);
    // The table holds eight digits.
    EXPECT_LT(largest_error(t, t.deformation), 1e-6) << "seed " << t.seed << " lambda " << t.contact.stiffness_ratio
                                                     << " " << row[5] << " " << row[7] << " " << row[8];
  }
}

/// What the tolerance can see: plane strain instead of stress, and a compliance wrong by a thousandth.
TEST(OracleModuli, SeesAWrongDeformation) {
  for (const auto& row : test::oracle_rows("packings/moduli_periodic_xy.csv")) {
    TableRow t = parse(row);
    if (!t.deformation.active() || t.seed != 1) continue;
    DeformationParameters strain = t.deformation;
    strain.plane = Plane::strain;
    EXPECT_GT(largest_error(t, strain), 1e-5);
    DeformationParameters softer = t.deformation;
    softer.young_modulus *= 0.999;
    EXPECT_GT(largest_error(t, softer), 1e-5);
  }
}

}  // namespace
}  // namespace ddem
