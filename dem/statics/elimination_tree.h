#pragma once
// In which order to eliminate the discs of an assembly from its equations, and what each elimination couples.

#include <span>
#include <vector>

#include "dem/core/bonds.h"
#include "dem/core/packing.h"

namespace ddem {

/// More discs than this are ordered, shared by threads and rounded for memory and time; fewer for the last bit.
inline constexpr int kManyDiscs = 20000;

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

/// Fronts that need nothing of each other: what each of these ranges begin .. end - 1 leaves over is that of its last front. The
/// ranges come to about equal work, however many take part in it; `top` are the fronts that are left, in their order.
struct Subtrees {
  struct Range {
    int begin, end;
  };
  std::vector<Range> ranges;
  std::vector<int> top;
};

/// One range of all fronts for few discs.
Subtrees subtrees_of(const EliminationTree& tree);

/// Of discs and not of their unknowns, which all are coupled alike: the graph is six times smaller. The order keeps the
/// factors sparse (minimum degree, or nested dissection of many discs); small fronts are joined where that adds few zeros.
EliminationTree elimination_tree(const Packing& packing, const Bonds& bonds);

}  // namespace ddem
