#pragma once
// Displacement, velocity, strain and stress of all nodes at a few times, on a mesh that programs for fields can show: every element cut into
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
  /// Snapshots x points: m, m/s, of strain the components of the tensor, Pa; strain and stress as node_strains() says.
  std::vector<double> displacement_x, displacement_y, velocity_x, velocity_y;
  std::vector<double> strain_xx, strain_yy, strain_xy, stress_xx, stress_yy, stress_xy;
};

/// Each of these with its name in files: there is one list of them.
struct NamedField {
  const char* name;
  std::vector<double> Fields::*values;
};
inline constexpr NamedField named_fields[] = {
    {"displacement_x", &Fields::displacement_x}, {"displacement_y", &Fields::displacement_y},
    {"velocity_x", &Fields::velocity_x},         {"velocity_y", &Fields::velocity_y},
    {"strain_xx", &Fields::strain_xx},           {"strain_yy", &Fields::strain_yy},
    {"strain_xy", &Fields::strain_xy},           {"stress_xx", &Fields::stress_xx},
    {"stress_yy", &Fields::stress_yy},           {"stress_xy", &Fields::stress_xy}};

}  // namespace ddem::fem
