#pragma once
// A simulation as a folder of plain files that any program can read, and the signals that it leaves there: the protocol of
// harness/guide/solvers.md. Discs are counted from 0; SI units; numbers in their shortest form that reads back as the same double.

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "dem/simulation/simulation.h"
#include "harness/io/signals_csv.h"

namespace ddem::harness {

/// Grows where a solver that follows the protocol before would no longer be right.
inline constexpr int kExchangeVersion = 1;

/// What is exchanged. Receiver k of the input is called receivers[k]: no commas, quotes or line breaks.
struct Exchange {
  const ddem::Assembly& assembly;
  const SimulationInput& input;
  std::vector<std::string> receivers;
  std::string title = {};
};

/// As laws are called: "normal", "full", "normal-only-stress".
const char* name_of(Correction correction);

/// V_p over pi r^2 thickness.
double volume_over_disc(const Exchange& exchange);

/// Samples of a run, the one at t = 0 among them.
long sample_count(const SimulationInput& input);

/// scene.json, discs.csv, bonds.csv, receivers.csv, and drive.csv where an edge is driven; in a folder that is there.
/// Throws as write_file(), and std::invalid_argument where implicit strains have no polynomial.
void write_exchange(const std::filesystem::path& folder, const Exchange& exchange);

/// The signals of a table with columns NAME_ux, NAME_uy, NAME_theta for each receiver, in any order among others (without
/// shear stiffness NAME_theta may be missing: 0). Throws InputError, naming `path`, where a column is missing.
Signals signals_of(const SignalTable& table, std::span<const std::string> receivers, bool with_rotation, const std::string& path);

/// The same of a run's file, which must have one row a sample, at its times. Throws InputError.
Signals read_exchange_signals(const std::filesystem::path& path, const Exchange& exchange);

}  // namespace ddem::harness
