#pragma once
// The scene file that reproduces a target: the user's own with the found values put in.

#include <string>

#include "harness/calibrate/calibrate.h"

namespace ddem::harness {

/// Random discs in the strip of the paper, as plain DEM: what is calibrated where no scene is given.
std::string default_assembly_text();

/// A pulse for it, so that `ddem run` has something to do: of 8 mm at that speed, m/s.
std::string default_load_text(double shear_speed);

/// scene.source_text with stiffness, k_t/k_n, density and, for deformable discs, E_p and nu_p of `found` in
/// place of what stands there, or added to their tables; everything else stays as it is, comments included.
/// Read back and compared: throws InputError where the file is written in a way (inline tables) that hides a
/// key's place.
std::string calibrated_text(const Scene& scene, const FoundParameters& found);

}  // namespace ddem::harness
