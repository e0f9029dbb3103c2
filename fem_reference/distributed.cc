#include "fem_reference/distributed.h"

#include <deal.II/base/mpi.h>

namespace ddem::fem {

DistributedProcesses::DistributedProcesses(const dealii::IndexSet& owned_dofs,
                                           const std::vector<dealii::types::global_dof_index>& dof_of_node) {
  // Two components a node, side by side.
  dealii::IndexSet owned(2 * owned_dofs.size()), ghosts(2 * owned_dofs.size());
  for (auto interval = owned_dofs.begin_intervals(); interval != owned_dofs.end_intervals(); ++interval) {
    owned.add_range(2 * *interval->begin(), 2 * (interval->last() + 1));
  }
  for (const auto dof : dof_of_node) {
    owned_.push_back(owned_dofs.is_element(dof) ? 1.0 : 0.0);
    if (owned_.back() == 0.0) ghosts.add_range(2 * dof, 2 * dof + 2);
  }
  owned.compress();
  ghosts.compress();
  vector_.reinit(owned, ghosts, MPI_COMM_WORLD);
  for (const auto dof : dof_of_node) {
    place_.push_back(vector_.get_partitioner()->global_to_local(2 * dof));
    place_y_.push_back(vector_.get_partitioner()->global_to_local(2 * dof + 1));
  }
}

void DistributedProcesses::add_shared(std::span<double> values) {
  vector_ = 0.0;  // ghosts, too
  for (std::size_t node = 0; node < place_.size(); ++node) {
    vector_.local_element(place_[node]) = values[2 * node];
    vector_.local_element(place_y_[node]) = values[2 * node + 1];
  }
  vector_.compress(dealii::VectorOperation::add);
  vector_.update_ghost_values();
  for (std::size_t node = 0; node < place_.size(); ++node) {
    values[2 * node] = vector_.local_element(place_[node]);
    values[2 * node + 1] = vector_.local_element(place_y_[node]);
  }
  vector_.zero_out_ghost_values();
}

void DistributedProcesses::sum(std::span<double> values) {
  const dealii::ArrayView<double> view(values.data(), values.size());
  dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(values.data(), values.size()), MPI_COMM_WORLD, view);
}

}  // namespace ddem::fem
