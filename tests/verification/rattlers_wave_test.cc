// Rattlers and waves: a pulse through a packing whose discs all but touch runs at the static speed of its network.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "harness/studies/strip/strip_campaign.h"
#include "harness/model/assemble.h"
#include "harness/model/load.h"
#include "harness/run/dem_run.h"
#include "harness/run/scene_moduli.h"
#include "harness/run/section_speeds.h"

namespace ddem::harness {
namespace {

Scene loose_strip(const char* wave) {
  return scene_of(fmt::format("[assembly]\npacking = \"random\"\nlength = \"66 mm\"\nwidth = \"2 mm\"\ndiscs = 2728\nbond_gap = 0.0005\n"
                              "[material]\ndensity = 2000\n[contact]\nnormal_stiffness = 1e10\nstiffness_ratio = 0.3\nnew_contacts = \"off\"\n"
                              "[boundary]\ntop_bottom = \"periodic\"\nright = \"fixed_x\"\n"
                              "[drive]\nwave = \"{}\"\nduration = \"10 us\"\namplitude = \"1 nm\"\n[probes]\npairs = 5\nsection = true\n",
                              wave),
                  wave);
}

/// Pulses of 12 and 20 mm, 60 discs and more: to a tenth of a per cent (P) and half a per cent (shear), what disorder throws back
/// between the pairs' sections. With the rattlers' mass the speeds would be 1.7 % lower.
TEST(Rattlers, DoNotMoveWithAWave) {
  for (const char* wave : {"shear", "longitudinal"}) {
    const Scene scene = loose_strip(wave);
    const ddem::Assembly a = build_network(scene);
    ASSERT_GE(a.rattlers.size(), 80u);
    EXPECT_GT(std::sqrt(bulk_density(a) / moving_density(a)), 1.015);
    const GrippedStrip grips = gripped(scene, a);
    const DemRun run = run_scene(scene, {});
    ASSERT_TRUE(run.measurement && run.measurement->speed.speed.ok());
    const bool shear = wave[0] == 's';
    const StaticSections::Speeds sections = section_speeds(grips, run.layout);
    const double measured = run.measurement->speed.speed.value().mean;
    EXPECT_NEAR(measured / (shear ? sections.s : sections.p), 1.0, 0.007) << wave;
    // And of the whole strip, which scatters from the part between the sections by some tenths of a per cent.
    const DirectionalSpeeds whole = directional_speeds(grips.stiffness(), moving_density(a));
    EXPECT_NEAR(measured / (shear ? whole.s : whole.p), 1.0, 0.012) << wave;
  }
}

/// Not even where a rattler stands outermost: it would be driven alone.
TEST(Rattlers, AreNoPartOfTheEdges) {
  int outermost = 0;
  for (int seed = 1; seed <= 24; ++seed) {
    const Scene scene = scene_of(fmt::format("[assembly]\npacking = \"random\"\nlength = \"4 mm\"\nwidth = \"1.6 mm\"\ndiscs = 150\nseed = {}\nbond_gap = 0.0005\n"
                                             "[material]\ndensity = 2000\n[contact]\nnormal_stiffness = 1e10\nstiffness_ratio = 0.3\n"
                                             "[boundary]\nleft = \"free\"\nright = \"fixed\"\n[drive]\nwave = \"shear\"\nduration = \"1 us\"\namplitude = \"1 nm\"\n",
                                             seed),
                                 "edges");
    const ddem::Assembly a = build_assembly(scene);
    const auto rattler = [&](int d) { return std::binary_search(a.rattlers.begin(), a.rattlers.end(), d); };
    outermost += rattler(static_cast<int>(std::min_element(a.packing.x.begin(), a.packing.x.end()) - a.packing.x.begin())) ? 1 : 0;
    const std::vector<int> driven = edge_drive(scene, a).value().discs;
    EXPECT_FALSE(driven.empty());
    EXPECT_TRUE(std::none_of(driven.begin(), driven.end(), rattler));
    const HeldDofs held = held_dofs(scene, a);
    for (const int d : a.rattlers) EXPECT_FALSE(held.x[static_cast<std::size_t>(d)]);
  }
  EXPECT_GE(outermost, 2);
}

}  // namespace
}  // namespace ddem::harness
