#include "harness/io/hdf5.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "harness/io/atomic_file.h"
#include "harness/io/errors.h"
#include "harness/io/hdf5_internal.h"
#include "harness/io/regular_file.h"
#include "harness/io/seal.h"

namespace ddem::harness {
namespace hdf5_detail {

std::string message(const std::string& place, const std::string& what) {
  std::string reason;
  const auto innermost = [](unsigned, const H5E_error2_t* error, void* into) -> herr_t {
    auto& text = *static_cast<std::string*>(into);
    if (text.empty() && error->desc != nullptr) text = error->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, innermost, &reason);
  H5Eclear2(H5E_DEFAULT);
  return reason.empty() ? place + ": " + what : place + ": " + what + ": " + reason;
}

hid_t written(hid_t id, const std::string& place, const std::string& what) {
  if (id < 0) throw MachineError(message(place, what));
  return id;
}

hid_t found(hid_t id, const std::string& place, const std::string& what) {
  if (id < 0) throw InputError(place + ": " + what);
  return id;
}

Hdf5Handle string_type() {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), H5T_VARIABLE);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  return type;
}

void require_storable(std::string_view text, const std::string& place) {
  if (text.find('\0') != std::string_view::npos)
    throw std::invalid_argument(place + ": text with zero bytes cannot be stored as a string");
}

}  // namespace hdf5_detail

using hdf5_detail::found;
using hdf5_detail::written;

void Hdf5Node::write_attribute(const std::string& name, hid_t stored, hid_t in_memory, const void* value) {
  const std::string place = place_ + "@" + name;
  const Hdf5Handle scalar(written(H5Screate(H5S_SCALAR), place, "cannot make a scalar"), H5Sclose);
  const Hdf5Handle attribute(
      written(H5Acreate2(handle_.get(), name.c_str(), stored, scalar.get(), H5P_DEFAULT, H5P_DEFAULT), place,
              "cannot create the attribute"),
      H5Aclose);
  written(H5Awrite(attribute.get(), in_memory, value), place, "cannot write the attribute");
}

void Hdf5Node::read_attribute(const std::string& name, hid_t in_memory, H5T_class_t expected,
                              void* value) const {
  const std::string place = place_ + "@" + name;
  const Hdf5Handle attribute(
      found(H5Aopen(handle_.get(), name.c_str(), H5P_DEFAULT), place, "no such attribute"), H5Aclose);
  const Hdf5Handle type(found(H5Aget_type(attribute.get()), place, "cannot read its type"), H5Tclose);
  const Hdf5Handle space(found(H5Aget_space(attribute.get()), place, "cannot read its shape"), H5Sclose);
  if (H5Tget_class(type.get()) != expected || H5Sget_simple_extent_npoints(space.get()) != 1 ||
      (expected == H5T_STRING && H5Tis_variable_str(type.get()) <= 0))
    throw InputError(place + ": the attribute has another type");
  found(H5Aread(attribute.get(), in_memory, value), place, "cannot read the attribute");
}

void Hdf5Node::set_attribute(const std::string& name, double value) {
  if (!std::isfinite(value))
    throw std::invalid_argument(
        fmt::format("{}@{}: a number that is not finite needs a status instead", place_, name));
  write_attribute(name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value);
}

void Hdf5Node::set_attribute(const std::string& name, std::int64_t value) {
  write_attribute(name, H5T_STD_I64LE, H5T_NATIVE_INT64, &value);
}

void Hdf5Node::set_attribute(const std::string& name, std::string_view text) {
  hdf5_detail::require_storable(text, place_ + "@" + name);
  const std::string copy(text);
  const char* pointer = copy.c_str();
  const Hdf5Handle type = hdf5_detail::string_type();
  write_attribute(name, type.get(), type.get(), &pointer);
}

bool Hdf5Node::has_attribute(const std::string& name) const {
  return H5Aexists(handle_.get(), name.c_str()) > 0;
}

double Hdf5Node::double_attribute(const std::string& name) const {
  double value = 0.0;
  read_attribute(name, H5T_NATIVE_DOUBLE, H5T_FLOAT, &value);
  return value;
}

std::int64_t Hdf5Node::int_attribute(const std::string& name) const {
  std::int64_t value = 0;
  read_attribute(name, H5T_NATIVE_INT64, H5T_INTEGER, &value);
  return value;
}

std::string Hdf5Node::string_attribute(const std::string& name) const {
  char* pointer = nullptr;
  const Hdf5Handle type = hdf5_detail::string_type();
  read_attribute(name, type.get(), H5T_STRING, &pointer);
  std::string text(pointer == nullptr ? "" : pointer);
  H5free_memory(pointer);
  return text;
}

std::string Hdf5Group::place_of(const std::string& name) const {
  return place_.back() == '/' ? place_ + name : place_ + "/" + name;
}

Hdf5Group Hdf5Group::create_group(const std::string& name) {
  const hid_t id = H5Gcreate2(handle_.get(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  return {Hdf5Handle(written(id, place_of(name), "cannot create the group"), H5Gclose), place_of(name)};
}

Hdf5Group Hdf5Group::group(const std::string& name) const {
  const hid_t id = H5Gopen2(handle_.get(), name.c_str(), H5P_DEFAULT);
  return {Hdf5Handle(found(id, place_of(name), "no such group"), H5Gclose), place_of(name)};
}

Hdf5Dataset Hdf5Group::dataset(const std::string& name) const {
  const hid_t id = H5Dopen2(handle_.get(), name.c_str(), H5P_DEFAULT);
  return {Hdf5Handle(found(id, place_of(name), "no such dataset"), H5Dclose), place_of(name)};
}

bool Hdf5Group::contains(const std::string& name) const {
  return H5Lexists(handle_.get(), name.c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::string> Hdf5Group::names() const {
  std::vector<std::string> all;
  const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* into) -> herr_t {
    static_cast<std::vector<std::string>*>(into)->emplace_back(name);
    return 0;
  };
  found(H5Literate(handle_.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &all), place_,
        "cannot list what is inside");
  return all;
}

namespace {

constexpr std::size_t memory_increment = 1 << 22;  // by which HDF5 lets a file in memory grow

/// Closing the file closes all that is open in it, and every use of HDF5 starts here.
Hdf5Handle access_properties() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  Hdf5Handle properties(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fclose_degree(properties.get(), H5F_CLOSE_STRONG);
  return properties;
}

Hdf5Handle in_memory() {
  Hdf5Handle properties = access_properties();
  written(H5Pset_fapl_core(properties.get(), memory_increment, false), "memory", "cannot hold an HDF5 file");
  return properties;
}

/// What a file in memory consists of, where HDF5 has it: a copy would take as much again.
std::string_view image_of(hid_t file, const std::string& path) {
  const std::string what = "cannot finish the HDF5 file";
  written(H5Fflush(file, H5F_SCOPE_LOCAL), path, what);
  const ssize_t size = H5Fget_file_image(file, nullptr, 0);
  void* memory = nullptr;  // of type char**
  written(size > 0 ? H5Fget_vfd_handle(file, H5P_DEFAULT, &memory) : -1, path, what);
  return {*static_cast<char**>(memory), static_cast<std::size_t>(size)};
}

}  // namespace

Hdf5File::Hdf5File(Hdf5Handle handle, std::string path, std::unique_ptr<AtomicFile> target)
    : handle_(std::move(handle)), path_(std::move(path)), target_(std::move(target)) {}
Hdf5File::Hdf5File(Hdf5File&&) noexcept = default;
Hdf5File& Hdf5File::operator=(Hdf5File&&) noexcept = default;
Hdf5File::~Hdf5File() = default;

Hdf5File Hdf5File::create(const std::filesystem::path& target) {
  auto file = std::make_unique<AtomicFile>(target);
  const std::string path = target.string();
  // In memory a file needs a name of its own, which is nowhere.
  const hid_t id = H5Fcreate(file->temporary_path().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, in_memory().get());
  return {Hdf5Handle(written(id, path, "cannot make an HDF5 file"), H5Fclose), path, std::move(file)};
}

Hdf5File Hdf5File::open(const std::filesystem::path& path) {
  const std::string bytes = read_regular_file(path), place = path.string();
  const std::string_view content = sealed_content(bytes, place);
  const Hdf5Handle properties = in_memory();
  // HDF5 copies the image, and does not write to it.
  found(H5Pset_file_image(properties.get(), const_cast<char*>(content.data()), content.size()), place, "cannot hold it");
  // Nor does it take a name that is a file's: below one there is none.
  const hid_t id = H5Fopen((place + "/image").c_str(), H5F_ACC_RDONLY, properties.get());
  return {Hdf5Handle(found(id, place, "is no HDF5 file"), H5Fclose), place, nullptr};
}

Hdf5File Hdf5File::open_unsealed(const std::filesystem::path& path) {
  const hid_t id = H5Fopen(path.c_str(), H5F_ACC_RDONLY, access_properties().get());
  return {Hdf5Handle(found(id, path.string(), "is no HDF5 file"), H5Fclose), path.string(), nullptr};
}

Hdf5Group Hdf5File::root() const {
  const hid_t id = H5Gopen2(handle_.get(), "/", H5P_DEFAULT);
  return {Hdf5Handle(found(id, path_, "the file is closed or has no root"), H5Gclose), path_ + ":/"};
}

void Hdf5File::close() {
  if (handle_.get() < 0) return;
  if (target_) {
    const std::string_view image = image_of(handle_.get(), path_);
    target_->append(image);
    target_->append(seal_of(image));
  }
  if (!handle_.reset()) throw MachineError(hdf5_detail::message(path_, "cannot close"));
  if (target_) target_->commit();
}

}  // namespace ddem::harness
