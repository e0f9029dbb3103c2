#pragma once
// From a case to what the kernel needs, by gmsh and deal.II: nodes, elements, edges, receivers. This header
// and everything that uses it know no deal.II.

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "fem_reference/cases.h"
#include "fem_reference/kernel/element_mesh.h"
#include "fem_reference/kernel/processes.h"
#include "fem_reference/strip_receivers.h"

namespace ddem::fem {

struct StripModel {
  ElementMesh mesh;       ///< nodes ordered along x first; periodic nodes merged
  std::vector<double> x, y;  ///< of each node, m
  /// Of each element, m, (xi, eta) = (0, 0), (1, 0), (0, 1), (1, 1): an element at the upper of two periodic edges has
  /// its corners there. Only for cases with snapshots.
  std::vector<std::array<std::array<double, 2>, 4>> corners;
  std::vector<std::uint32_t> left_nodes, right_nodes;
  std::vector<NodeWeights> points;    ///< value at each point of the receivers
  std::vector<NodeWeights> sections;  ///< average over the height at each section, exact for the elements
  /// Where several processes have a part of the model each (mpirun): receivers' values are then parts of sums. Else
  /// empty.
  std::shared_ptr<Processes> processes;
};

/// Builds models; keeps each mesh that gmsh has made, since many cases of a campaign share one.
class StripModeller {
 public:
  StripModeller();
  ~StripModeller();

  /// Those of users, before anything is solved. Throws CaseError with all that is wrong with any of them.
  void read_meshes(const std::vector<StripCase>& cases);

  /// Throws std::runtime_error if gmsh or deal.II fail.
  StripModel model(const StripCase& strip);

 private:
  struct Meshes;
  std::unique_ptr<Meshes> meshes_;
};

}  // namespace ddem::fem
