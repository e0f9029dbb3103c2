#pragma once
// A solver beside the built-in one, on the same strips: what it is given is the same to the last bit, so that all differences are its own.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/io/members.h"
#include "harness/solvers/solver.h"

namespace ddem::harness {

/// One law in one strip, and one solver.
struct SolverTask {
  std::string solver;   ///< as it was asked for
  std::string label;    ///< in names of cases: the name, or that of the description's file
  std::string packing;  ///< "random": 200 discs, periodic above and below, shear; "hexagonal": 240 discs, free, bar
  std::string law;      ///< as law_of()
  double stiffness_ratio = 0.0;

  std::string id() const;  ///< "solvers/lammps/random/dem/kt0.00"
};

struct SolverResult {
  std::string failure = "not run";
  std::string name, version;
  // Of its motion against the built-in one, all discs, over the largest: at 1e-6 mean radii of amplitude.
  double displacement_error = 0.0, rotation_error = 0.0;
  std::vector<double> amplitude, amplitude_error;  ///< over the mean radius; the same errors of displacements, larger amplitudes
  std::vector<double> step, step_change;           ///< over the critical one; change of the displacements when the step is halved
  std::optional<double> energy_drift;
  double speed = 0.0, builtin_speed = 0.0, static_speed = 0.0;  ///< m/s; 0: none, and why:
  std::string speed_reason;
  double nanoseconds = 0.0, builtin_nanoseconds = 0.0;          ///< a bond and step
  std::vector<double> time, signal, builtin_signal;             ///< at the middle disc, s, m

  /// Order in the step, and of the error in the amplitude; empty where the changes are round-off.
  std::optional<double> order() const, amplitude_order() const;
};
DDEM_MEMBERS(SolverResult, failure, name, version, displacement_error, rotation_error, amplitude, amplitude_error, step, step_change, energy_drift, speed,
             builtin_speed, static_speed, speed_reason, nanoseconds, builtin_nanoseconds, time, signal, builtin_signal)

struct ComparedSolver {
  SolverTask task;
  SolverResult found;
};

/// The laws and strips that every solver is asked for.
std::vector<SolverTask> solver_tasks(const std::string& solver, const std::string& label);

/// UnsupportedError where the solver cannot do it; what else keeps it from a result is thrown too.
SolverResult measure_solver(const SolverTask& task, const Solver& solver);

}  // namespace ddem::harness
