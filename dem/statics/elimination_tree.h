#pragma once
// In which order to eliminate the discs of an assembly from its equations, and what each elimination couples.

#include <span>
#include <vector>

#include "dem/core/bonds.h"

namespace ddem {

/// Discs that are eliminated together, as one dense matrix: those of the places begin .. end - 1.
struct Front {
  int begin = 0, end = 0;
  std::vector<int> rest;      ///< places of the later discs that they are coupled with, ascending
  std::vector<int> children;  ///< the fronts whose first disc of the rest is one of these; all of them come before
  int own() const { return end - begin; }
};

struct EliminationTree {
  std::vector<int> place;     ///< of each disc in the order of elimination
  std::vector<Front> fronts;  ///< in that order
  std::vector<int> front_of;  ///< of each place
};

/// Of discs and not of their unknowns, which all are coupled alike: the graph is six times smaller. The order keeps the
/// factors sparse (minimum degree); small fronts are joined where that adds few zeros.
EliminationTree elimination_tree(int discs, const Bonds& bonds);

}  // namespace ddem
