#pragma once
// What the keys of a scene mean together: keys that contradict each other, keys without which nothing can be
// simulated, values that are right alone and impossible side by side.

#include "harness/scene/values.h"

namespace ddem::harness {

/// What the scene is read for, which decides what must be in it.
enum class Purpose {
  packing,     ///< [assembly] alone
  statics,     ///< and [material], [contact]
  simulation,  ///< and [initial] or [drive]
  continuum,   ///< as simulation, but a complete [continuum] of given length and width replaces discs, [material] and [contact]
};

/// Adds to the violations of `values`. Never accuses a key that is already known to be wrong, nor what
/// depends on it.
void check_scene(Values& values, Purpose purpose);

/// A [continuum] that leaves nothing to the discs.
bool continuum_is_complete(const Values& values);

}  // namespace ddem::harness
