#pragma once
// ddem measure SCENE.toml SIGNALS.csv ...

#include <string>
#include <vector>

namespace ddem::harness {

/// `words`: scenes and signals in turns, one pair or two (a bar and a shear wave, or a P and a shear wave, of one material: then
/// Poisson's ratio follows). Prints what was measured; the exit code. Throws InputError.
int measure_scenes(const std::vector<std::string>& words, bool json);

}  // namespace ddem::harness
