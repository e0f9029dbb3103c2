#pragma once
// One simulation in time: velocity Verlet (as leapfrog) of bonded discs, DEM or DDEM.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dem/assembly/assembly.h"
#include "dem/core/material.h"
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

struct SimulationInput {
  ContactParameters contact;
  DeformationParameters deformation;
  HeldDofs held;
  InitialState initial;
  std::optional<EdgeDrive> drive;
  double time_step = 0.0;  ///< s
  long steps = 0;
  int sample_every = 1;
  std::vector<Receiver> receivers;
  int threads = 1;
  /// Called now and then with the fraction done; return false to stop.
  std::function<bool(double)> on_progress;
};

/// Sampled signals: value[receiver][sample].
struct Signals {
  std::vector<double> time;
  std::vector<std::vector<double>> ux, uy, theta;
};

struct Divergence {
  long step = 0;
  int disc = 0;
};

struct SimulationResult {
  Signals signals;
  std::optional<Divergence> divergence;  ///< set: the run stopped there, its signals end before
  bool stopped = false;                  ///< on_progress asked for it
  long steps_done = 0;
  double wall_seconds = 0.0;  ///< of the time loop
  /// Largest relative deviation of the leapfrog invariant (see energy.h) from its first value, from the end of the drive on. Empty for nonlinear kinematics, which has no such invariant.
  std::optional<double> energy_drift;
  InitialState final_state;  ///< displacements at the last step, velocities half a step before
};

/// Throws std::invalid_argument on a non-positive time step, negative steps, wrong sizes or indices.
SimulationResult simulate(const Assembly& assembly, const SimulationInput& input);

}  // namespace ddem
