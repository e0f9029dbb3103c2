#pragma once
// Processes by MPI, with deal.II's index sets and its exchange of ghost values.

#include <deal.II/base/index_set.h>
#include <deal.II/lac/la_parallel_vector.h>

#include "fem_reference/kernel/processes.h"

namespace ddem::fem {

class DistributedProcesses : public Processes {
 public:
  /// `owned_dofs` of all scalar degrees of freedom, one a node; `dof_of_node` of this process's nodes.
  DistributedProcesses(const dealii::IndexSet& owned_dofs, const std::vector<dealii::types::global_dof_index>& dof_of_node);

  void add_shared(std::span<double> values) override;
  void sum(std::span<double> values) override;
  const std::vector<double>& owned() const override { return owned_; }

 private:
  std::vector<double> owned_;
  std::vector<unsigned> place_;  ///< of each node's ux in the vector
  std::vector<unsigned> place_y_;
  dealii::LinearAlgebra::distributed::Vector<double> vector_;
};

}  // namespace ddem::fem
