#pragma once
// How the elements of a mesh fit together, and what its outline is called.

#include "meshes/mesh_draft.h"
#include "meshes/msh_file.h"

namespace ddem::meshes {

/// Fills in the edges of the mesh. Refuses elements that do not cover the rectangle once by whole edges, and edges of the
/// outline that are not in the physical curve of their side, and in that alone of the four. For elements that passed
/// check_quads, nodes on the sides exactly.
void check_outline(MeshDraft& draft, const MshFile& file);

}  // namespace ddem::meshes
