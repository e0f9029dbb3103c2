#pragma once
// Stiffness and lumped mass of plane elastodynamics, M u'' = -K u, on spectral elements.
//
// The slopes along the reference directions, g = (ux_xi, ux_eta, uy_xi, uy_eta), give the energy 1/2 sum_q w_q g' C g
// with a symmetric 4 x 4 matrix at each point, one for all points of a parallelogram,
//     C(ia, kb) = |J| sum_jl Jinv(a, j) c_ijkl Jinv(b, l),
// and f = K u is its derivative, with the slopes by sum factorisation at the Gauss-Lobatto points.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "dem/core/team.h"
#include "fem_reference/kernel/element_mesh.h"
#include "fem_reference/kernel/material.h"
#include "fem_reference/kernel/processes.h"
#include "fem_reference/kernel/stiffness_kernel.h"

namespace ddem::fem {

class ElasticOperator {
 public:
  /// Throws std::invalid_argument for a mesh whose arrays do not fit together or an element without area.
  ElasticOperator(const ElementMesh& mesh, const PlaneMaterial& material,
                  InstructionSet set = best_instruction_set());

  std::size_t node_count() const { return mass_.size(); }
  /// Length of displacement and force arrays: 2 a node, interleaved, and one node that pads the last batch.
  std::size_t vector_size() const { return 2 * (mass_.size() + 1); }
  /// Lumped mass of each node, kg per metre of thickness.
  const std::vector<double>& mass() const { return mass_; }

  /// f = K u, N per metre of thickness; both of vector_size() entries, u's padding node zero. The same bits for any
  /// number of threads.
  void apply(std::span<const double> u, std::span<double> f) const;

  /// The same as one thread's share of a job of team(), which all of its threads must take; ends with a meeting.
  void apply_share(std::span<const double> u, std::span<double> f, int thread) const;

  /// Works with `team` from now on, which must outlive this; until then alone.
  void use(Team& team) { team_ = &team; }
  Team& team() const { return *team_; }

  /// Shares the mesh with other processes from now on: mass(), apply() and dot() then are those of the whole. All
  /// processes must call them together.
  void use(Processes& processes);
  /// Null without.
  Processes* processes() const { return processes_; }

  /// Of vectors of vector_size() entries.
  double dot(std::span<const double> a, std::span<const double> b) const;

 private:
  struct Block {
    std::size_t first_batch, last_batch;
  };

  void add_mass(const ElementMesh& mesh, double density);
  void colour_blocks();
  void pack(const ElementMesh& mesh, const PlaneMaterial& material);

  std::vector<double> derivative_, divergence_, weights_;
  std::vector<double> mass_;
  std::vector<std::uint32_t> batch_nodes_;
  std::vector<double> batch_coefficients_;
  /// Blocks of one colour share no node: threads may add to the force of different blocks at once, and every node
  /// gets its contributions in the order of the colours.
  std::vector<std::vector<Block>> colours_;
  StiffnessKernel kernel_;
  std::unique_ptr<Team> alone_ = std::make_unique<Team>(1);
  Team* team_ = alone_.get();
  Processes* processes_ = nullptr;
};

}  // namespace ddem::fem
