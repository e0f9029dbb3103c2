#pragma once
// One way to damage a right mesh, applied at many places.

#include <gtest/gtest.h>

#include <functional>

#include "tests/support/strip_meshes.h"

namespace ddem::meshes {

inline constexpr int nx = 7, ny = 4, outline = 2 * (nx + ny);

/// Empty where the mesh is accepted.
inline std::string refusal(const std::string& bytes, const StripSpec& strip) {
  try {
    const QuadMesh mesh = parse_user_mesh(bytes, strip);
    EXPECT_TRUE(test::is_mesh_of(mesh, strip));
    return {};
  } catch (const MeshError& error) {
    return error.what();
  }
}

struct Damage {
  const char* name;
  const char* reason;
  std::function<void(test::TestMesh&, int i, int j)> apply;  ///< to or near element (i, j)
};

}  // namespace ddem::meshes
