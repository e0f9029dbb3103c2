// Arrays to and from HDF5 datasets.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "harness/io/errors.h"
#include "harness/io/hdf5.h"
#include "harness/io/hdf5_internal.h"

namespace ddem::harness {
namespace {

using hdf5_detail::found;
using hdf5_detail::written;

constexpr std::size_t chunked_from_bytes = 64 * 1024;
constexpr std::size_t chunk_bytes = 1024 * 1024;   // HDF5's chunk cache holds one megabyte
constexpr hssize_t max_elements = 10'000'000'000;  // what a broken file claims beyond is not allocated
constexpr double most_inflated = 1100.0;           // by deflate, of what is stored

std::vector<hsize_t> dimensions(const std::vector<std::size_t>& shape, std::size_t count,
                                const std::string& place) {
  if (shape.empty() || shape.size() > 3)
    throw std::invalid_argument(
        fmt::format("{}: an array has one to three dimensions, not {}", place, shape.size()));
  std::size_t product = 1;
  for (const std::size_t extent : shape) product *= extent;
  if (product != count)
    throw std::invalid_argument(
        fmt::format("{}: {} values do not fill a shape of {}", place, count, product));
  return {shape.begin(), shape.end()};
}

/// Chunks of whole rows (first index) of about a megabyte; small datasets stay contiguous.
Hdf5Handle creation_properties(const std::vector<hsize_t>& extent, std::size_t count,
                               std::size_t element_bytes) {
  Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  if (count * element_bytes < chunked_from_bytes) return properties;
  std::vector<hsize_t> chunk = extent;
  std::size_t bytes = count * element_bytes;
  for (hsize_t& side : chunk) {  // cut the slowest index first, down to 1, then the next
    const std::size_t slice = bytes / side;
    side = std::clamp<hsize_t>(chunk_bytes / slice, 1, side);
    bytes = slice * side;
    if (bytes <= chunk_bytes) break;
    bytes = slice;
  }
  H5Pset_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data());
  if (H5Zfilter_avail(H5Z_FILTER_DEFLATE) > 0) {
    H5Pset_shuffle(properties.get());
    H5Pset_deflate(properties.get(), 4);
  }
  return properties;
}

/// An opened dataset with its shape, or InputError where its type is not of the class wanted.
struct Source {
  Hdf5Handle dataset, type, space;
  std::vector<std::size_t> shape;
  std::size_t count;
};

/// Whether a dataset shows parts of other files.
bool looks_elsewhere(hid_t dataset) {
  const Hdf5Handle made(H5Dget_create_plist(dataset), H5Pclose);
  bool elsewhere = H5Pget_external_count(made.get()) != 0;
  std::size_t views = 0;
  if (H5Pget_layout(made.get()) == H5D_VIRTUAL) H5Pget_virtual_count(made.get(), &views);
  for (std::size_t k = 0; k < views; ++k) {
    char file[2] = "";
    elsewhere = elsewhere || H5Pget_virtual_filename(made.get(), k, file, sizeof file) != 1 || file[0] != '.';
  }
  return elsewhere;
}

/// Whether what is stored can be unpacked to as many bytes: a forged size must not ask for all memory. A view stores nothing.
bool can_hold(hid_t dataset, hssize_t count, std::size_t element_bytes) {
  const Hdf5Handle made(H5Dget_create_plist(dataset), H5Pclose);
  const double most = most_inflated * static_cast<double>(H5Dget_storage_size(dataset));
  return H5Pget_layout(made.get()) == H5D_VIRTUAL || static_cast<double>(count) * static_cast<double>(element_bytes) <= most;
}

Source open_source(hid_t group, const std::string& name, const std::string& place, H5T_class_t expected) {
  H5L_info_t link;
  found(H5Lget_info(group, name.c_str(), &link, H5P_DEFAULT), place, "no such dataset");
  if (link.type != H5L_TYPE_HARD) throw InputError(place + ": a link instead of a dataset");
  Hdf5Handle dataset(found(H5Dopen2(group, name.c_str(), H5P_DEFAULT), place, "no such dataset"), H5Dclose);
  Hdf5Handle type(found(H5Dget_type(dataset.get()), place, "cannot read its type"), H5Tclose);
  if (H5Tget_class(type.get()) != expected) throw InputError(place + ": the dataset has another type");
  Hdf5Handle space(found(H5Dget_space(dataset.get()), place, "cannot read its shape"), H5Sclose);
  const hssize_t count = H5Sget_simple_extent_npoints(space.get());
  if (count < 0 || count > max_elements || !can_hold(dataset.get(), count, H5Tget_size(type.get())))
    throw InputError(fmt::format("{}: {} elements cannot be read", place, count));
  if (looks_elsewhere(dataset.get())) throw InputError(place + ": shows parts of other files");
  const int rank = H5Sget_simple_extent_ndims(space.get());
  std::vector<hsize_t> extent(static_cast<std::size_t>(std::max(rank, 0)));
  if (rank > 0) H5Sget_simple_extent_dims(space.get(), extent.data(), nullptr);
  return {std::move(dataset),
          std::move(type),
          std::move(space),
          {extent.begin(), extent.end()},
          static_cast<std::size_t>(count)};
}

}  // namespace

Hdf5Dataset Hdf5Group::write_array(const std::string& name, std::vector<std::size_t> shape, std::size_t count,
                                   hid_t type, const void* values) {
  const std::string place = place_of(name);
  if (shape.empty()) shape = {count};
  const std::vector<hsize_t> extent = dimensions(shape, count, place);
  const Hdf5Handle space(written(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr),
                                 place, "cannot shape"),
                         H5Sclose);
  const Hdf5Handle properties = creation_properties(extent, count, H5Tget_size(type));
  Hdf5Handle dataset(written(H5Dcreate2(handle_.get(), name.c_str(), type, space.get(), H5P_DEFAULT,
                                        properties.get(), H5P_DEFAULT),
                             place, "cannot create the dataset"),
                     H5Dclose);
  if (count > 0)
    written(H5Dwrite(dataset.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), place,
            "cannot write the dataset");
  return {std::move(dataset), place};
}

Hdf5Dataset Hdf5Group::write(const std::string& name, std::span<const double> values,
                             std::vector<std::size_t> shape) {
  Hdf5Dataset dataset = write_array(name, std::move(shape), values.size(), H5T_NATIVE_DOUBLE, values.data());
  const auto bad = std::find_if(values.begin(), values.end(), [](double v) { return !std::isfinite(v); });
  if (bad != values.end())
    dataset.set_attribute("status", fmt::format("holds numbers that are not finite, first at flat index {}",
                                                bad - values.begin()));
  return dataset;
}

Hdf5Dataset Hdf5Group::write(const std::string& name, std::span<const int> values,
                             std::vector<std::size_t> shape) {
  return write_array(name, std::move(shape), values.size(), H5T_NATIVE_INT, values.data());
}

Hdf5Dataset Hdf5Group::write(const std::string& name, const std::vector<std::string>& texts) {
  std::vector<const char*> pointers;
  for (const std::string& text : texts) {
    hdf5_detail::require_storable(text, place_of(name));
    pointers.push_back(text.c_str());
  }
  const Hdf5Handle type = hdf5_detail::string_type();
  return write_array(name, {}, texts.size(), type.get(), pointers.data());
}

Hdf5Array<double> Hdf5Group::read_doubles(const std::string& name) const {
  Source source = open_source(handle_.get(), name, place_of(name), H5T_FLOAT);
  Hdf5Array<double> array{std::move(source.shape), std::vector<double>(source.count)};
  found(H5Dread(source.dataset.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.values.data()),
        place_of(name), "cannot read the dataset");
  return array;
}

Hdf5Array<int> Hdf5Group::read_ints(const std::string& name) const {
  const Source source = open_source(handle_.get(), name, place_of(name), H5T_INTEGER);
  // Wider integers would be clamped silently.
  if (H5Tget_size(source.type.get()) > sizeof(int))
    throw InputError(place_of(name) + ": integers too wide to read");
  Hdf5Array<int> array{source.shape, std::vector<int>(source.count)};
  found(H5Dread(source.dataset.get(), H5T_NATIVE_INT, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.values.data()),
        place_of(name), "cannot read the dataset");
  return array;
}

std::vector<std::string> Hdf5Group::read_strings(const std::string& name) const {
  const Source source = open_source(handle_.get(), name, place_of(name), H5T_STRING);
  if (H5Tis_variable_str(source.type.get()) <= 0)
    throw InputError(place_of(name) + ": strings of fixed length cannot be read");
  std::vector<char*> pointers(source.count, nullptr);
  const Hdf5Handle type = hdf5_detail::string_type();
  found(H5Dread(source.dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()),
        place_of(name), "cannot read the dataset");
  std::vector<std::string> texts;
  for (const char* pointer : pointers) texts.emplace_back(pointer == nullptr ? "" : pointer);
  H5Dvlen_reclaim(type.get(), source.space.get(), H5P_DEFAULT, pointers.data());
  return texts;
}

}  // namespace ddem::harness
