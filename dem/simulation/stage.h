#pragma once
// A step is a row of stages: the particle strains first, then the motion. Each is one sweep of a kernel over the discs.

namespace ddem {

enum class Stage {
  evaluate,                          ///< lagged: a further evaluation of the strains
  source, iterate,                   ///< implicit, polynomial
  residual, apply, advance, turn,    ///< implicit, conjugate gradients
  motion,                            ///< forces, velocities, displacements: ends the step of one thread
  seams                              ///< what the shares of several threads have left of that to each other
};

}  // namespace ddem
