#include "fem_reference/signals_file.h"

#include <hdf5.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fem_reference/file_limit.h"

namespace ddem::fem {
namespace {

constexpr const char* not_written = "HDF5 cannot hold the signals";

hid_t checked(hid_t id) {
  if (id < 0) throw FileError(not_written);
  return id;
}

void check(herr_t status) {
  if (status < 0) throw FileError(not_written);
}

class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close closer) : id_(checked(id)), close_(closer) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }  // NOLINT: a handle is used as the id it holds
  // Closing a dataset or a group writes what is left: that may fail, and must be seen.
  void close() { check(close_(std::exchange(id_, -1))); }

 private:
  hid_t id_;
  Close close_;
};

Handle space(const std::vector<hsize_t>& shape) {
  return shape.empty()
             ? Handle(H5Screate(H5S_SCALAR), H5Sclose)
             : Handle(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose);
}

// Of `type` in memory and in the file.
void write_array(hid_t group, const char* name, const std::vector<hsize_t>& shape, hid_t type, const void* data) {
  const Handle extent = space(shape);
  Handle dataset(H5Dcreate2(group, name, type, extent, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
  if (H5Sget_simple_extent_npoints(extent) > 0) check(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data));
  dataset.close();
}

void write_dataset(hid_t group, const char* name, const std::vector<hsize_t>& shape, std::span<const double> data) {
  write_array(group, name, shape, H5T_NATIVE_DOUBLE, data.data());
}

void write_fields(hid_t parent, const Fields& fields) {
  Handle group(H5Gcreate2(parent, "fields", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  const hsize_t points = fields.mesh.x.size(), snapshots = fields.time.size();
  write_dataset(group, "x", {points}, fields.mesh.x);
  write_dataset(group, "y", {points}, fields.mesh.y);
  write_array(group, "quadrilaterals", {fields.mesh.quadrilaterals.size(), 4}, H5T_NATIVE_UINT32,
              fields.mesh.quadrilaterals.data());
  write_dataset(group, "time", {snapshots}, fields.time);
  for (const NamedField& f : named_fields) write_dataset(group, f.name, {snapshots, points}, fields.*f.values);
  group.close();
}

void write_attribute(hid_t object, const char* name, hid_t stored, hid_t native,
                     const std::vector<hsize_t>& shape, const void* data) {
  const Handle extent = space(shape);
  Handle attribute(H5Acreate2(object, name, stored, extent, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  check(H5Awrite(attribute, native, data));
  attribute.close();
}

void write_integer(hid_t object, const char* name, std::uint64_t value) {
  write_attribute(object, name, H5T_STD_U64LE, H5T_NATIVE_UINT64, {}, &value);
}

void write_number(hid_t object, const char* name, double value) {
  write_attribute(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, {}, &value);
}

void write_text(hid_t object, const char* name, const std::string& value) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  check(H5Tset_size(type, H5T_VARIABLE));
  check(H5Tset_cset(type, H5T_CSET_UTF8));
  const char* text = value.c_str();
  write_attribute(object, name, type, type, {}, &text);
}

// HDF5 grows the file in memory by this much at a time.
constexpr std::size_t memory_increment = 1 << 22;

hid_t create_in_memory() {
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  check(H5Pset_fapl_core(access, memory_increment, false));
  return H5Fcreate("signals", H5F_ACC_TRUNC, H5P_DEFAULT, access);
}

std::vector<char> image_of(hid_t file) {
  check(H5Fflush(file, H5F_SCOPE_LOCAL));
  const ssize_t size = H5Fget_file_image(file, nullptr, 0);
  if (size <= 0) throw FileError(not_written);
  std::vector<char> image(static_cast<std::size_t>(size));
  if (H5Fget_file_image(file, image.data(), image.size()) != size) throw FileError(not_written);
  return image;
}

// Opened anew beside its target, and gone with the object unless it took the target's place.
class FileBeside {
 public:
  explicit FileBeside(const std::filesystem::path& target)
      : target_(target), path_(target.string() + ".part" + std::to_string(getpid())), stream_(path_, std::ios::binary | std::ios::trunc) {
    if (!stream_) fail(errno);
  }
  ~FileBeside() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove(path_, ignored);
  }
  FileBeside(const FileBeside&) = delete;
  FileBeside& operator=(const FileBeside&) = delete;

  // Where a full disk or a limit takes nothing at all.
  void try_a_byte() {
    if (!stream_.put('\0').flush()) fail(errno);
  }

  void replace_target(const std::vector<char>& content) {
    if (!stream_.write(content.data(), static_cast<std::streamsize>(content.size())).flush()) fail(errno);
    stream_.close();
    if (!stream_) fail(errno);
    std::error_code status;
    const auto replaced = std::filesystem::status(target_, status);
    if (std::filesystem::exists(replaced)) std::filesystem::permissions(path_, replaced.permissions(), status);
    std::filesystem::rename(path_, target_, status);
    if (status) fail(status.value());
    path_.clear();
  }

 private:
  [[noreturn]] void fail(int error) const {
    throw FileError("cannot write " + target_.string() + ": " + file_error_text(error));
  }

  std::filesystem::path target_, path_;
  std::ofstream stream_;
};

}  // namespace

struct SignalsFile::Open {
  Handle file;
};

void check_replaceable(const std::filesystem::path& target) {
  constexpr std::string_view signature = "\x89HDF\r\n\x1a\n";
  std::error_code status;
  if (!std::filesystem::is_regular_file(target, status) || std::filesystem::file_size(target, status) == 0) return;
  std::string begin(signature.size(), '\0');
  std::ifstream(target, std::ios::binary).read(begin.data(), static_cast<std::streamsize>(begin.size()));
  if (begin != signature) throw CaseError(target.string() + ": is there and is no HDF5 file; it is not overwritten, name another file");
}

SignalsFile::SignalsFile(const std::filesystem::path& target, const std::string& program) : target_(target) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors are reported once, by the exception
  std::error_code status;
  if (std::filesystem::is_symlink(target_, status)) target_ = std::filesystem::weakly_canonical(target_, status);
  if (std::filesystem::exists(target_, status) && !std::filesystem::is_regular_file(target_, status)) {
    throw FileError(target_.string() + " is no file");
  }
  FileBeside(target_).try_a_byte();  // to know now, not after hours of solving, and gone while they pass
  open_.reset(new Open{{create_in_memory(), H5Fclose}});
  write_integer(open_->file, "schema", 1);
  write_text(open_->file, "program", program);
}

SignalsFile::~SignalsFile() = default;

void SignalsFile::write(const StripCase& strip, const CaseResult& result) {
  Handle group(H5Gcreate2(open_->file, strip.id.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  const hsize_t samples = result.time.size();
  write_dataset(group, "time", {samples}, result.time);
  const std::size_t points = strip.receivers.points.size(), sections = strip.receivers.sections.size();
  const auto columns = [&](std::size_t first, std::size_t count) {
    std::vector<double> part;
    part.reserve(samples * 2 * count);
    for (std::size_t row = 0; row < samples; ++row) {
      const auto begin = result.signals.begin() + static_cast<std::ptrdiff_t>(2 * (row * (points + sections) + first));
      part.insert(part.end(), begin, begin + static_cast<std::ptrdiff_t>(2 * count));
    }
    return part;
  };
  write_dataset(group, "points", {samples, points, 2}, columns(0, points));
  write_dataset(group, "sections", {samples, sections, 2}, columns(points, sections));
  if (!result.fields.time.empty()) write_fields(group, result.fields);
  std::array<std::uint64_t, 2> elements{strip.elements[0], strip.elements[1]};
  if (!strip.mesh.empty()) elements = {result.elements, 1};
  write_attribute(group, "elements", H5T_STD_U64LE, H5T_NATIVE_UINT64, {2}, elements.data());
  write_integer(group, "element_count", result.elements);
  write_integer(group, "degree", static_cast<std::uint64_t>(strip.degree));
  write_integer(group, "dofs", result.dofs);
  write_integer(group, "steps", result.steps);
  write_number(group, "critical_time_step", result.critical_time_step);
  write_number(group, "time_step", result.time_step);
  write_number(group, "sample_interval", result.sample_interval);
  write_number(group, "solve_seconds", result.solve_seconds);
  if (result.energy_drift) write_number(group, "energy_drift", *result.energy_drift);
  write_text(group, "status", result.status);
  group.close();
}

void SignalsFile::commit() {
  FileBeside(target_).replace_target(image_of(open_->file));
}

}  // namespace ddem::fem
