#pragma once
// The part of HDF5 that results need, as values that close themselves. Serial HDF5, one thread at a time.
//
//   Hdf5File file = Hdf5File::create("results.h5");
//   Hdf5Group signals = file.root().create_group("signals");
//   signals.write("disc12_ux", values).set_attribute("unit", "m");
//   file.close();
//
// Writing fails as MachineError, reading as InputError, both with file and path inside it. HDF5's own messages to
// standard error are off.
//
// HDF5 1.10 crashes after a write that the disk refused, and on files with a byte changed. So it never meets either: what it
// makes stays in memory until it is whole, and a file of ours ends with a digest of all its bytes (io/seal.h; other
// readers of HDF5 do not look behind the end of its data).

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#ifdef H5_HAVE_PARALLEL
#error "the serial flavour of HDF5 is needed here: see CMakeLists.txt"
#endif

namespace ddem::harness {

class AtomicFile;

/// Owns an HDF5 identifier.
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);

  Hdf5Handle(hid_t id, Close close) : id_(id), close_(close) {}
  ~Hdf5Handle() { reset(); }
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;

  hid_t get() const { return id_; }
  /// False where closing failed.
  bool reset() { return id_ < 0 || close_(std::exchange(id_, -1)) >= 0; }

 private:
  hid_t id_;
  Close close_;
};

/// What has attributes: a group or a dataset.
class Hdf5Node {
 public:
  /// A name is given once (else MachineError). A double must be finite, and text free of zero bytes: std::invalid_argument otherwise.
  void set_attribute(const std::string& name, double value);
  void set_attribute(const std::string& name, std::int64_t value);
  void set_attribute(const std::string& name, int value) { set_attribute(name, std::int64_t{value}); }
  void set_attribute(const std::string& name, std::string_view text);
  void set_attribute(const std::string& name, const char* text) {
    set_attribute(name, std::string_view(text));
  }

  bool has_attribute(const std::string& name) const;
  double double_attribute(const std::string& name) const;
  std::int64_t int_attribute(const std::string& name) const;
  std::string string_attribute(const std::string& name) const;

  /// "FILE:/path/inside", for messages.
  const std::string& place() const { return place_; }

 protected:
  Hdf5Node(Hdf5Handle handle, std::string place) : handle_(std::move(handle)), place_(std::move(place)) {}

  Hdf5Handle handle_;
  std::string place_;

 private:
  void write_attribute(const std::string& name, hid_t stored, hid_t in_memory, const void* value);
  void read_attribute(const std::string& name, hid_t in_memory, H5T_class_t expected, void* value) const;
};

class Hdf5Dataset : public Hdf5Node {
 private:
  friend class Hdf5Group;
  using Hdf5Node::Hdf5Node;
};

/// Values in row-major order: the last index runs fastest.
template <class T>
struct Hdf5Array {
  std::vector<std::size_t> shape;
  std::vector<T> values;
};

/// A row of a matrix that the file holds.
struct Hdf5Row {
  std::string dataset;  ///< its path from the root, such as "/fields/stress_xx"
  std::size_t row = 0;
};

class Hdf5Group : public Hdf5Node {
 public:
  Hdf5Group create_group(const std::string& name);
  Hdf5Group group(const std::string& name) const;
  Hdf5Dataset dataset(const std::string& name) const;
  bool contains(const std::string& name) const;
  /// Of the groups and datasets inside, in the order of their names.
  std::vector<std::string> names() const;

  /// One to three dimensions; `shape` left out: one. Above 64 kB in chunks, shuffled and deflated where the
  /// library can. Values that are not finite are stored with an attribute `status` that says so and where the
  /// first one is.
  Hdf5Dataset write(const std::string& name, std::span<const double> values,
                    std::vector<std::size_t> shape = {});
  Hdf5Dataset write(const std::string& name, std::span<const int> values,
                    std::vector<std::size_t> shape = {});
  /// One-dimensional.
  Hdf5Dataset write(const std::string& name, const std::vector<std::string>& texts);

  /// A matrix that stores nothing of its own (HDF5's virtual dataset): column c shows rows[c], and further ones up to `columns` are
  /// zero; a single column is a list. The rows' datasets must be there, matrices of doubles with rows of equal length.
  Hdf5Dataset write_view(const std::string& name, std::span<const Hdf5Row> rows, std::size_t columns);

  Hdf5Array<double> read_doubles(const std::string& name) const;
  Hdf5Array<int> read_ints(const std::string& name) const;
  std::vector<std::string> read_strings(const std::string& name) const;

 private:
  friend class Hdf5File;
  using Hdf5Node::Hdf5Node;

  std::string place_of(const std::string& name) const;
  Hdf5Dataset write_array(const std::string& name, std::vector<std::size_t> shape, std::size_t count,
                          hid_t type, const void* values);
};

class Hdf5File {
 public:
  Hdf5File(Hdf5File&&) noexcept;
  Hdf5File& operator=(Hdf5File&&) noexcept;
  ~Hdf5File();

  /// Takes the place of `target` at close(), whole, and vanishes without it; errors as of AtomicFile.
  static Hdf5File create(const std::filesystem::path& target);
  /// A file that was made by create(), every byte of it.
  static Hdf5File open(const std::filesystem::path& path);
  /// Any file, whatever HDF5 makes of it: only for what another program of ours has just written.
  static Hdf5File open_unsealed(const std::filesystem::path& path);

  Hdf5Group root() const;
  /// Writes the file, where it was created. Groups and datasets of it must not be used any more.
  void close();

 private:
  Hdf5File(Hdf5Handle handle, std::string path, std::unique_ptr<AtomicFile> target);

  Hdf5Handle handle_;
  std::string path_;
  std::unique_ptr<AtomicFile> target_;  ///< of a file that is being made
};

}  // namespace ddem::harness
