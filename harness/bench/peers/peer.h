#pragma once
// One other program: how to ask for its version, and how to let it run the scene. A new one is a file beside lammps.cc and
// a line in peer_plans() (peers.cc).

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dem/assembly/assembly.h"
#include "dem/simulation/simulation.h"

namespace ddem::harness::bench {

/// Equal discs of a free lattice without damping, from rest positions with these velocities; peers are given it in units
/// of a diameter, a disc's mass and k_n, as their tolerances and bins are made for numbers near 1.
struct PeerScene {
  const ddem::Assembly& assembly;
  ddem::InitialState start;  ///< velocities alone, m/s
  long steps = 0;
  double time_step = 0.0;         ///< s
  std::filesystem::path folder;   ///< where the peer's files go

  double diameter() const;        ///< the unit of length, m
  double unit_of_time() const;    ///< sqrt(m/k_n), s
};

struct PeerRun {
  double seconds = 0.0;        ///< the program's own time of its loop
  std::vector<double> ux, uy;  ///< at the end, m
};

struct Peer {
  std::string name, law;
  bool shear = false;            ///< with shear stiffness and rotations (kShearRatio of lattice.h)
  std::string program, package;  ///< on the PATH, or a path; of Debian
  std::string (*version)(const std::string& program) = nullptr;
  /// Throws MachineError with what the program said.
  PeerRun (*run)(const std::string& program, const PeerScene& scene) = nullptr;
};

Peer lammps();  ///< harmonic bonds
Peer yade();    ///< cohesive bonds with incremental shear and rotations

/// What stands in a text between two marks; not empty.
std::optional<std::string_view> between(std::string_view text, std::string_view before, std::string_view after);

/// Runs a program in the scene's folder and returns what it printed. Throws MachineError with the end of what it said where it fails.
std::string run_in_folder(const PeerScene& scene, const std::string& program, const std::vector<std::string>& arguments);

/// The finite number that stands between two marks of what the program printed. Throws MachineError.
double seconds_said(const std::string& program, const std::string& printed, std::string_view before, std::string_view after);

}  // namespace ddem::harness::bench
