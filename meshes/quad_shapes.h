#pragma once
// Each element of a mesh by itself.

#include "meshes/mesh_draft.h"

namespace ddem::meshes {

/// Refuses elements that are doubled, crossed, bent inwards, flat, or turned against the others of their surface, and nodes
/// that lie at one place. Lets all corners run counterclockwise: a whole surface may have been listed the other way.
void check_quads(MeshDraft& draft);

}  // namespace ddem::meshes
