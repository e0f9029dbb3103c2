#pragma once
// Several processes that share a mesh: each has some of the elements and all of their nodes, and every node is owned by
// one of the processes that have it. Called once a step or less.

#include <cstdint>
#include <span>
#include <vector>

namespace ddem::fem {

class Processes {
 public:
  virtual ~Processes() = default;

  /// Replaces the values of nodes that several processes have, interleaved as displacements are, by their sum: the same
  /// bits in all of them. Every process must call it.
  virtual void add_shared(std::span<double> values) = 0;

  /// Replaces each number by its sum over all processes.
  virtual void sum(std::span<double> values) = 0;

  /// Of each node, 1 where this process owns it, else 0.
  virtual const std::vector<double>& owned() const = 0;
};

}  // namespace ddem::fem
