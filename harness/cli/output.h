#pragma once
// Signals to files: CSV and HDF5, the same columns.

#include <string>
#include <utility>
#include <vector>

#include "harness/io/signals_csv.h"
#include "harness/scene/scene.h"

namespace ddem::harness {

/// One probe's displacements (and rotation) as columns name_ux, name_uy(, name_theta).
void add_probe(SignalTable& table, const std::string& name, const std::vector<double>& ux, const std::vector<double>& uy,
               const std::vector<double>* theta);

/// /signals with one dataset a column; the scene's text and the provenance as attributes of the file.
void write_signals_hdf5(const std::string& path, const SignalTable& table, const Scene& scene);

/// Writes what the user asked for; empty paths: nothing.
void write_outputs(const std::string& hdf5_path, const std::string& csv_path, const SignalTable& table, const Scene& scene);

}  // namespace ddem::harness
