#pragma once
// Signals to files: CSV and HDF5, the same columns.

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "harness/io/hdf5.h"
#include "harness/io/signals_csv.h"
#include "harness/scene/scene.h"

namespace ddem::harness {

/// One probe's displacements (and rotation) as columns name_ux, name_uy(, name_theta).
void add_probe(SignalTable& table, const std::string& name, const std::vector<double>& ux, const std::vector<double>& uy,
               const std::vector<double>* theta);

/// Further groups of an HDF5 file.
using MoreGroups = std::function<void(Hdf5Group& root)>;

/// /signals with one dataset a column; the scene's text and the provenance as attributes of the file; and `more`.
void write_signals_hdf5(const std::string& path, const SignalTable& table, const Scene& scene, const MoreGroups& more);

/// Writes what the user asked for; empty paths: nothing.
void write_outputs(const std::string& hdf5_path, const std::string& csv_path, const SignalTable& table, const Scene& scene,
                   const MoreGroups& more = [](Hdf5Group&) {});

}  // namespace ddem::harness
