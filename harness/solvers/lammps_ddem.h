#pragma once
// A scene as input of ddem-lammps (dem/lammps): a data file and a script that its users can read, edit and run alone.

#include <filesystem>

#include "harness/solvers/exchange.h"

namespace ddem::harness {

inline constexpr const char* kLammpsData = "strip.data";
inline constexpr const char* kLammpsScript = "in.strip";
/// Initial displacements, where there are some.
inline constexpr const char* kLammpsInitial[] = {"ux.txt", "uy.txt", "theta.txt"};

/// In a folder that is there. Throws as write_file(), UnsupportedError where lammps_ddem_refusal() has a reason.
void write_lammps_ddem(const std::filesystem::path& folder, const Exchange& exchange);

/// What ddem-lammps cannot do, in words; empty: nothing.
std::string lammps_ddem_refusal(const ddem::Assembly& assembly, const SimulationInput& input);

}  // namespace ddem::harness
