// Views: datasets that show parts of others.

#include <array>
#include <stdexcept>

#include "harness/io/hdf5.h"
#include "harness/io/hdf5_internal.h"

namespace ddem::harness {
namespace {

using hdf5_detail::written;

/// Of a matrix of doubles.
std::array<hsize_t, 2> matrix_shape(hid_t group, const std::string& path, const std::string& place) {
  const Hdf5Handle dataset(written(H5Dopen2(group, path.c_str(), H5P_DEFAULT), place,
                                   "a view of " + path + ", which is not there"),
                           H5Dclose);
  const Hdf5Handle space(written(H5Dget_space(dataset.get()), place, "cannot read the shape of " + path),
                         H5Sclose);
  std::array<hsize_t, 2> extent{};
  if (H5Sget_simple_extent_ndims(space.get()) != 2)
    throw std::invalid_argument(place + ": a view of " + path + ", which is no matrix");
  H5Sget_simple_extent_dims(space.get(), extent.data(), nullptr);
  return extent;
}

}  // namespace

Hdf5Dataset Hdf5Group::write_view(const std::string& name, std::span<const Hdf5Row> rows,
                                  std::size_t columns) {
  const std::string place = place_of(name);
  if (rows.empty() || columns < rows.size())
    throw std::invalid_argument(place + ": a view needs rows, and a column for each");
  const hsize_t length = matrix_shape(handle_.get(), rows.front().dataset, place)[1];
  const std::array<hsize_t, 2> extent{length, columns};
  const int rank = columns == 1 ? 1 : 2;
  const Hdf5Handle space(written(H5Screate_simple(rank, extent.data(), nullptr), place, "cannot shape"),
                         H5Sclose);
  const Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  const double zero = 0.0;
  H5Pset_fill_value(properties.get(), H5T_NATIVE_DOUBLE, &zero);
  for (std::size_t c = 0; c < rows.size(); ++c) {
    const std::array<hsize_t, 2> shape = matrix_shape(handle_.get(), rows[c].dataset, place);
    if (rows[c].row >= shape[0] || shape[1] != length)
      throw std::invalid_argument(place + ": a view of a row that " + rows[c].dataset + " has not got");
    const Hdf5Handle source(H5Screate_simple(2, shape.data(), nullptr), H5Sclose);
    const std::array<hsize_t, 2> row_start{rows[c].row, 0}, row_count{1, length}, column_start{0, c},
        column_count{length, 1};
    H5Sselect_hyperslab(source.get(), H5S_SELECT_SET, row_start.data(), nullptr, row_count.data(), nullptr);
    H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, column_start.data(), nullptr, column_count.data(),
                        nullptr);
    // "." is the file itself, whatever it is called later.
    written(H5Pset_virtual(properties.get(), space.get(), ".", rows[c].dataset.c_str(), source.get()), place,
            "cannot view " + rows[c].dataset);
  }
  H5Sselect_all(space.get());
  const hid_t id = H5Dcreate2(handle_.get(), name.c_str(), H5T_NATIVE_DOUBLE, space.get(), H5P_DEFAULT,
                              properties.get(), H5P_DEFAULT);
  return {Hdf5Handle(written(id, place, "cannot create the view"), H5Dclose), place};
}

}  // namespace ddem::harness
