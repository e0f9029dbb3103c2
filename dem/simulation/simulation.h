#pragma once
// One simulation in time: velocity Verlet (as leapfrog) of bonded discs, DEM or DDEM.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dem/assembly/assembly.h"
#include "dem/core/material.h"
#include "dem/simulation/audit.h"
#include "dem/statics/static_solver.h"

namespace ddem {

/// State at t = 0, one value a disc; an empty vector means zero. m, rad, m/s, rad/s.
struct InitialState {
  std::vector<double> ux, uy, theta, vx, vy, omega;
};

enum class Direction { x, y };

/// Prescribed motion of discs in one direction: A sin^2(pi t / T) for 0 <= t <= T, then held at 0. Their other
/// displacement and rotation stay free.
struct EdgeDrive {
  std::vector<int> discs;
  Direction direction = Direction::x;
  double amplitude = 0.0, duration = 0.0;

  double displacement(double time) const;
};

/// A receiver records the mean displacement and rotation of its discs (one disc, or a section).
struct Receiver {
  std::vector<int> discs;
};

/// Whether discs that are not bonded may touch (new_contacts.h).
enum class ContactWatch {
  off,
  bound,      ///< looked at only where a bound of what has moved says that some may have closed
  every_step  ///< the same results at more work: to check the bound
};

struct SimulationInput {
  ContactParameters contact;
  DeformationParameters deformation;
  /// Of the polynomial's implicit strains, strain_relaxations(), where the caller knows them: finding them takes as long
  /// as hundreds of steps. Else empty.
  std::vector<double> relaxations;
  HeldDofs held;  ///< stay where `initial` displaces them
  InitialState initial;
  std::optional<EdgeDrive> drive;  ///< overrules `initial`
  double time_step = 0.0;  ///< s
  long steps = 0;
  long sample_every = 1;
  std::vector<Receiver> receivers;
  int energy_samples = 50;  ///< about so many over the run, and the last step; 0: none
  int snapshots = 0;        ///< so many over the run, equally spaced, the last at its end
  int threads = 1;
  bool follow_front = true;  ///< no work where nothing can have moved yet; without it the same bits, at more work
  int steps_a_sweep = 0;     ///< 0: as many as stay in cache; the same bits for any number
  ContactWatch new_contacts = ContactWatch::off;  ///< without friction; see ContactWatch
  /// Called now and then with the fraction done; return false to stop.
  std::function<bool(double)> on_progress;
};

/// Sampled signals: value[receiver][sample].
struct Signals {
  std::vector<double> time;
  std::vector<std::vector<double>> ux, uy, theta;
};

/// A run that could not go on.
struct Breakdown {
  enum class Cause {
    diverged,               ///< displacements that are not finite, or far beyond what the load can cause
    strains_not_converged,  ///< conjugate gradients found no implicit strains
    strains_indefinite,     ///< the system of the implicit strains is not positive definite
    contacts_undecided      ///< implicit: no set of closed contacts agrees with the strains that it causes, or one closes
                            ///< where conjugate gradients find the strains, which take none in
  } cause = Cause::diverged;
  long step = 0;
  int disc = 0;
};

/// Energies at a time, J: see audit.h.
struct EnergySample {
  double time = 0.0;
  Energies energies;
};

/// All discs at a time; one value a disc. Stress and strain of a disc: tensor components, Pa and 1. For nonlinear
/// kinematics without stress; for rigid discs without strain (empty).
struct Snapshot {
  double time = 0.0;
  InitialState state;  ///< velocities half a step later than the displacements
  TensorField stress, strain;
};

/// New contacts of a run.
struct NewContactCount {
  long first_step = 0;
  std::size_t most = 0;  ///< closed at once
  /// 2/omega_max were every pair near enough to be watched closed, s: with some of them closed the step is safe below it.
  /// 0 after a breakdown.
  double critical_time_step = 0.0;
};

struct SimulationResult {
  Signals signals;
  std::optional<Breakdown> breakdown;  ///< set: the run stopped there, its signals end before
  bool stopped = false;                  ///< on_progress asked for it
  long steps_done = 0;
  double wall_seconds = 0.0;  ///< of the time loop, without energies and snapshots
  /// Largest relative deviation of the leapfrog invariant (see audit.h) from its first value, from the end of the drive
  /// on. Empty for nonlinear kinematics, which has no such invariant.
  std::optional<double> energy_drift;
  std::vector<EnergySample> energy;  ///< likewise empty
  std::vector<Snapshot> snapshots;
  std::optional<NewContactCount> new_contacts;  ///< empty where none closed
  InitialState final_state;  ///< displacements at the last step, velocities half a step before
};

/// Throws std::invalid_argument on a non-positive time step, negative steps, wrong sizes or indices, and velocities of what
/// is held.
void check_input(const Assembly& assembly, const SimulationInput& input);

/// As many of `threads` as make a run of so many discs faster: between two sweeps they wait for each other.
int worthwhile_threads(int threads, std::size_t discs);

/// Throws as check_input().
SimulationResult simulate(const Assembly& assembly, const SimulationInput& input);

}  // namespace ddem
