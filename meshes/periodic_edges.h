#pragma once
// Top and bottom of a mesh as one line.

#include "meshes/mesh_draft.h"

namespace ddem::meshes {

/// Moves each node of the top right over its partner at the bottom. Refuses nodes without a partner within
/// partner_tolerance. For meshes that passed check_outline.
void match_periodic_edges(MeshDraft& draft);

}  // namespace ddem::meshes
