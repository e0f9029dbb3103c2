// Rattlers are no part of the network: whatever statics say of a packing, they say of it without its rattlers too.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "dem/assembly/particle_volume.h"
#include "dem/spectra/spectra.h"
#include "dem/statics/moduli.h"
#include "meshes/packings/random.h"
#include "tests/support/assemblies.h"
#include "tests/support/parameters.h"

namespace ddem {
namespace {

constexpr double kRadius = 1.13e-4, kEdgeBand = 1.2 * kRadius;

/// Bonds that all but touch: one disc in twenty to one in five is a rattler.
Assembly loose(std::uint64_t seed, bool periodic_x, bool periodic_y) {
  Packing p = packings::random_jammed({.length = 8e-3, .width = 1.6e-3, .discs = 300, .seed = seed});
  const Bonds bonds = cut_at_edges(p, bonds_within_gap(p, 1e-3 * mean_radius(p)), !periodic_x, !periodic_y);
  p.period = {periodic_x ? p.length : 0.0, periodic_y ? p.width : 0.0};
  return make_assembly(p, bonds, 0.37, test::kDensity, RattlerRule::peel);
}

/// With the place of each disc in what is left; -1: gone.
struct Without {
  Assembly assembly;
  std::vector<int> place;
};

Without without_rattlers(const Assembly& a) {
  Without out;
  out.place.assign(a.size(), -1);
  Packing p{{}, {}, {}, a.packing.period, a.packing.length, a.packing.width};
  for (const int d : network_discs(a)) {
    out.place[static_cast<std::size_t>(d)] = static_cast<int>(p.size());
    p.x.push_back(a.packing.x[d]), p.y.push_back(a.packing.y[d]), p.radius.push_back(a.packing.radius[d]);
  }
  Bonds bonds = a.bonds;
  for (auto* ends : {&bonds.i, &bonds.j}) {
    for (int& d : *ends) d = out.place[static_cast<std::size_t>(d)];
  }
  out.assembly = make_assembly(p, bonds, a.thickness, a.density);
  return out;
}

std::vector<DeformationParameters> laws() {
  std::vector<DeformationParameters> laws = {{}};
  for (const Correction c : {Correction::normal, Correction::full, Correction::normal_only_stress}) {
    for (const ParticleVolume v : {ParticleVolume::disc, ParticleVolume::cell}) {
      laws.push_back(test::strains(Scheme::implicit, c, 0.25));
      laws.back().volume = v;
    }
  }
  return laws;
}

/// The same sums in another order: round-off times the condition of a strip (1e4 in its forces, and 1e2 on the way to strains).
constexpr double kSame = 1e-9;

void expect_same(double with, double without) { EXPECT_NEAR(with / without, 1.0, kSame); }

class Network : public testing::TestWithParam<std::uint64_t> {};
INSTANTIATE_TEST_SUITE_P(Seeds, Network, testing::Values(1, 2, 3, 4));

TEST_P(Network, IsWhatAFreeStripIs) {
  const Assembly a = loose(GetParam(), false, false);
  ASSERT_GE(a.rattlers.size(), 15u);
  const Without b = without_rattlers(a);
  expect_same(moving_density(a), bulk_density(b.assembly));
  EXPECT_LT(moving_density(a), 0.99 * bulk_density(a));
  for (const Edge e : {Edge::left, Edge::right, Edge::bottom, Edge::top}) {
    std::vector<int> discs;
    for (const int d : edge_discs(a, e, kEdgeBand)) discs.push_back(b.place[static_cast<std::size_t>(d)]);
    EXPECT_EQ(discs, edge_discs(b.assembly, e, kEdgeBand));
  }
  const ContactParameters contact = test::linear_contact(0.3);
  for (const DeformationParameters& d : laws()) {
    const StripTension with = pull_strip(a, contact, d, kEdgeBand), without = pull_strip(b.assembly, contact, d, kEdgeBand);
    expect_same(with.axial_stiffness, without.axial_stiffness);
    expect_same(with.mass_per_length, without.mass_per_length);
    // A piece that hangs on one bond may turn about it: of that only the regularisation decides, and round-off a little.
    EXPECT_NEAR(with.lateral_contraction.value() / without.lateral_contraction.value(), 1.0, 1e-6);
  }
}

TEST_P(Network, IsWhatWavesBetweenPeriodicEdgesMove) {
  const Assembly a = loose(GetParam(), false, true);
  const Without b = without_rattlers(a);
  ASSERT_GE(a.rattlers.size(), 5u);
  const ContactParameters contact = test::linear_contact(0.3);
  std::vector<SectionDiscs> with(2), without(2);
  for (const int d : network_discs(a)) {
    for (const std::size_t s : {0u, 1u}) {
      if (std::abs(a.packing.x[d] - (s == 0 ? 0.3 : 0.7) * a.packing.length) > 2.0 * kRadius) continue;
      with[s].push_back(d);
      without[s].push_back(b.place[static_cast<std::size_t>(d)]);
    }
  }
  for (const DeformationParameters& d : laws()) {
    const PlaneStiffness c = homogenise_strip(a, contact, d, kEdgeBand), c_without = homogenise_strip(b.assembly, contact, d, kEdgeBand);
    EXPECT_LT((c - c_without).cwiseAbs().maxCoeff(), kSame * c.cwiseAbs().maxCoeff());
    const auto speeds = static_sections(a, contact, d, kEdgeBand, with).between(0, 1);
    const auto speeds_without = static_sections(b.assembly, contact, d, kEdgeBand, without).between(0, 1);
    expect_same(speeds.p, speeds_without.p);
    expect_same(speeds.s, speeds_without.s);
  }
}

TEST_P(Network, IsWhatACellIs) {
  const Assembly a = loose(GetParam(), true, true);
  const Without b = without_rattlers(a);
  ASSERT_GE(a.rattlers.size(), 3u);
  const ContactParameters contact = test::linear_contact(0.3);
  for (const DeformationParameters& d : laws()) {
    const PlaneStiffness c = homogenise_cell(a, contact, d), without = homogenise_cell(b.assembly, contact, d);
    EXPECT_LT((c - without).cwiseAbs().maxCoeff(), kSame * c.cwiseAbs().maxCoeff());
    expect_same(volume_over_square_radius(a, d), volume_over_square_radius(b.assembly, d));
  }
  expect_same(largest_frequency(a, contact, {}), largest_frequency(b.assembly, contact, {}));
}

TEST(NetworkDiscs, AreAllButTheRattlers) {
  const Assembly a = loose(1, false, false);
  std::vector<int> all = network_discs(a);
  all.insert(all.end(), a.rattlers.begin(), a.rattlers.end());
  std::sort(all.begin(), all.end());
  for (std::size_t d = 0; d < all.size(); ++d) EXPECT_EQ(all[d], static_cast<int>(d));
  EXPECT_EQ(all.size(), a.size());
}

}  // namespace
}  // namespace ddem
