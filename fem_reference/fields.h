#pragma once
// Displacement and velocity of all nodes at a few times, on a mesh that programs for fields can show: every element cut into
// degree x degree quadrilaterals between its Gauss-Lobatto nodes.

#include <array>
#include <cstdint>
#include <vector>

#include "fem_reference/strip_model.h"

namespace ddem::fem {

/// A node that two periodic edges share is two points.
struct FieldMesh {
  std::vector<std::uint32_t> nodes;  ///< of the model, one a point; its nodes in their order come first
  std::vector<double> x, y;          ///< of each point, m
  std::vector<std::array<std::uint32_t, 4>> quadrilaterals;  ///< points, anticlockwise
};

/// Needs StripModel::corners.
FieldMesh field_mesh(const StripModel& model);

struct Fields {
  FieldMesh mesh;
  std::vector<double> time;                                                    ///< of the snapshots, s
  std::vector<double> displacement_x, displacement_y, velocity_x, velocity_y;  ///< snapshots x points, m and m/s
};

}  // namespace ddem::fem
