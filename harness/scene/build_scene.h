#pragma once
// The struct of scene.h from values that have passed every check.

#include "harness/scene/scene.h"
#include "harness/scene/values.h"

namespace ddem::harness {

/// `values` must be free of violations after check_scene(). Sets everything but path and source_text.
Scene build_scene(const Values& values);

}  // namespace ddem::harness
