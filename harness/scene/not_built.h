#pragma once
// Settings that a scene may ask for and that this version does not simulate yet.

#include "harness/scene/check_scene.h"
#include "harness/scene/values.h"

namespace ddem::harness {

/// Adds a violation "not built yet" for each of them that the scene asks for, for discs or (Purpose::continuum) for the
/// continuum.
void reject_not_built(Values& values, Purpose purpose);

}  // namespace ddem::harness
