#pragma once
// The table of key_rules.h applied to a scene.

#include "harness/scene/values.h"

namespace ddem::harness {

/// Refuses what contradicts another key, or means nothing beside it; each key once.
void check_rules(Values& values, bool discs_needed);

}  // namespace ddem::harness
