#pragma once
// What is wrong with a mesh.

#include <stdexcept>

namespace ddem::meshes {

/// What is wrong with the file, and what would be right; a line for each problem.
class MeshError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

}  // namespace ddem::meshes
