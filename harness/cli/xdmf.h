#pragma once
// A mesh with fields over time for other programs: XDMF, which ParaView and meshio open, beside the HDF5 file.

#include <filesystem>
#include <string>
#include <vector>

#include "harness/io/hdf5.h"

namespace ddem::harness {

/// A field of the points.
struct XdmfField {
  std::string name;
  std::vector<std::string> components;  ///< datasets of /fields, snapshots x points: one, or two of a vector
  bool is_vector() const { return components.size() > 1; }
};

/// What /fields holds of points that stay where they are.
struct XdmfSeries {
  std::string name;           ///< "discs"
  std::string topology;       ///< XDMF's name of the cells
  std::string cells_dataset;  ///< of /points: cells x nodes_per_cell
  std::size_t points = 0, cells = 0, nodes_per_cell = 1;
  std::vector<double> times;           ///< of the snapshots, s
  std::vector<std::string> constants;  ///< datasets of /fields that hold at all times
  std::vector<XdmfField> fields;
};

/// FILE.xdmf beside FILE.h5. Throws InputError for a name that XDMF cannot hold.
std::filesystem::path xdmf_path(const std::filesystem::path& hdf5);

/// /points: position (points x 3, m), the cells, `cells` x nodes_per_cell numbers of points, and a group 0000, 0001, ... a
/// snapshot with the series' fields as views of /fields, which must be there: they store nothing twice. Vectors are points x 3.
void write_series(Hdf5Group& root, const XdmfSeries& series, const std::vector<double>& position, const std::vector<int>& cells);

/// The text of the XDMF file. `hdf5`: the file's name, in the same folder.
std::string xdmf_text(const XdmfSeries& series, const std::string& hdf5);

}  // namespace ddem::harness
