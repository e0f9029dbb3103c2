#pragma once
// Scenes to calibrate.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "harness/calibrate/calibrate.h"
#include "harness/scene/read_scene.h"

namespace ddem::harness::test {

inline Scene scene_of(const std::string& text) {
  const SceneResult scene = parse_scene(text, "scene.toml", ".", {Purpose::statics});
  EXPECT_TRUE(scene) << to_string(scene.violations);
  return *scene;
}

inline const char* const kDiscs =
    "[material]\ndensity = 2000.0\n\n[contact]\nnormal_stiffness = 1e10\nstiffness_ratio = 0.25\n\n";

/// Of any softness: a calibration does not look at it.
inline std::string deformation_text(const std::string& scheme, const std::string& correction) {
  return scheme.empty() ? ""
                        : fmt::format(
                              "[deformation]\nscheme = \"{}\"\ncorrection = \"{}\"\nyoung_modulus = "
                              "4e10\npoisson_ratio = 0.3\n",
                              scheme, correction);
}

/// The infinite lattice.
inline Scene lattice_scene(const std::string& scheme = "", const std::string& correction = "") {
  return scene_of(std::string("[assembly]\npacking = \"hexagonal\"\ncolumns = 4\nrows = 4\nradius = "
                              "1e-4\nperiodic = \"xy\"\n\n") +
                  kDiscs + deformation_text(scheme, correction));
}

/// The strip of the paper: 682 random discs, periodic in y.
inline Scene strip_scene(const std::string& scheme = "", const std::string& correction = "") {
  return scene_of(std::string("[assembly]\npacking = \"random\"\nlength = 16.5e-3\nwidth = 2e-3\ndiscs = "
                              "682\nseed = 1\ncoordination = 5.8\n\n") +
                  kDiscs + deformation_text(scheme, correction) + "[boundary]\ntop_bottom = \"periodic\"\n");
}

inline Target target_of(double young, double poisson) {
  WantedValues wanted;
  wanted.of(TargetKind::young) = Uncertain{young, 0.0};
  wanted.of(TargetKind::poisson) = Uncertain{poisson, 0.0};
  wanted.density = 2400.0;
  return make_target(wanted);
}

inline SearchSpace held(std::optional<double> ratio, std::optional<double> softness,
                        std::optional<double> nu_p) {
  SearchSpace space;
  if (ratio) space.stiffness_ratio = {*ratio, *ratio};
  if (softness) space.softness = {*softness, *softness};
  if (nu_p) space.particle_poisson_ratio = {*nu_p, *nu_p};
  return space;
}

}  // namespace ddem::harness::test
