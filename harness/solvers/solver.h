#pragma once
// A solver is whatever turns an assembly and its input into signals. All above that, picks, speeds, verdicts, reports, works for any.

#include <memory>
#include <string>
#include <vector>

#include "dem/simulation/exact.h"
#include "dem/simulation/simulation.h"

namespace ddem::harness {

/// What a solver can be asked for.
struct Abilities {
  std::vector<std::string> laws;  ///< as law_of() names them
  bool exact_in_time = false;     ///< Solver::solve_exact()
  bool nonlinear = false;         ///< kinematics of the current geometry
  bool new_contacts = false;      ///< of discs that are not bonded
  bool periodic = false;          ///< edges
  bool held_discs = false;
  bool driven_edge = false;
  bool energies = false, snapshots = false;
};

class Solver {
 public:
  virtual ~Solver() = default;
  virtual std::string name() const = 0;
  virtual std::string version() const = 0;
  /// Of equal identity, and of equal inputs, results are equal; empty: as those of this program.
  virtual std::string identity() const { return ""; }
  virtual Abilities abilities() const = 0;
  /// What else of an input it cannot do, in words; empty: it can.
  virtual std::string further_refusal(const ddem::Assembly&, const SimulationInput&) const { return ""; }
  /// Signals of the input's receivers at t = 0 and after every `sample_every` steps. A divergence is in the result. Throws
  /// std::invalid_argument as check_input(), UnsupportedError where refusal() has a reason, MachineError where a program cannot be
  /// started, fails, or leaves no signals or wrong ones, and SolverError where it diverges.
  virtual SimulationResult solve(const ddem::Assembly& assembly, const SimulationInput& input) const = 0;
  /// Without an error of the time step, see simulate_exact(). std::logic_error where it is not among the abilities.
  virtual SimulationResult solve_exact(const ddem::Assembly& assembly, const SimulationInput& input, const Sampling& sampling) const;
};

/// "dem", "lagged-normal", "lagged-full", "implicit-normal-only-stress" ...
std::string law_of(const DeformationParameters& deformation);

/// Of a disc, m, that the input puts in: at first, by its velocity, and by the driven edge.
double displacement_put_in(const SimulationInput& input);

/// Whether the load can bring discs together that are not bonded: where it cannot, new contacts are nothing to ask a solver for.
/// A bound: two waves of the largest displacement that the input puts in, one from either side.
bool may_close_gaps(const ddem::Assembly& assembly, const SimulationInput& input);

/// What the input asks for and the solver cannot do, in words; empty: it can.
std::string refusal(const Solver& solver, const ddem::Assembly& assembly, const SimulationInput& input);

/// dem/simulation, in this process: all of it.
const Solver& builtin_solver();

}  // namespace ddem::harness
