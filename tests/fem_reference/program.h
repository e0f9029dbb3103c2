#pragma once
// ddem-fem as a test sees it: a case file as JSON, the exit code, what it said, and the signals file read
// back.

#include <hdf5.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/work_folder.h"

namespace ddem::fem::test {

struct Signals {
  std::vector<double> time;
  std::vector<double> points, sections;  ///< n x receivers x 2
  std::size_t point_count = 0, section_count = 0;

  double point(std::size_t sample, std::size_t k, int component) const {
    return points[(sample * point_count + k) * 2 + component];
  }
  double section(std::size_t sample, std::size_t k, int component) const {
    return sections[(sample * section_count + k) * 2 + component];
  }
};

class SignalsReader {
 public:
  explicit SignalsReader(const std::filesystem::path& file)
      : file_(checked(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), file.string())) {}
  ~SignalsReader() { H5Fclose(file_); }
  SignalsReader(const SignalsReader&) = delete;
  SignalsReader& operator=(const SignalsReader&) = delete;

  Signals signals(const std::string& id) const {
    Signals s;
    std::vector<hsize_t> shape;
    s.time = read(id + "/time", shape);
    s.points = read(id + "/points", shape);
    s.point_count = shape.at(1);
    s.sections = read(id + "/sections", shape);
    s.section_count = shape.at(1);
    return s;
  }

  /// Of a dataset, by its path in the file.
  std::vector<double> values(const std::string& path) const {
    std::vector<hsize_t> shape;
    return read(path, shape);
  }
  bool contains(const std::string& path) const { return H5Lexists(file_, path.c_str(), H5P_DEFAULT) > 0; }

  bool has(const std::string& id, const std::string& attribute) const {
    return H5Aexists_by_name(file_, id.c_str(), attribute.c_str(), H5P_DEFAULT) > 0;
  }

  double number(const std::string& id, const std::string& attribute) const {
    double value = 0.0;
    const hid_t handle = open(id, attribute);
    const herr_t status = H5Aread(handle, H5T_NATIVE_DOUBLE, &value);
    H5Aclose(handle);
    checked(status, attribute);
    return value;
  }

  std::string text(const std::string& id, const std::string& attribute) const {
    const hid_t handle = open(id, attribute), type = H5Aget_type(handle);
    char* value = nullptr;
    const herr_t status = H5Aread(handle, type, &value);
    const std::string result = status >= 0 && value != nullptr ? value : "";
    H5free_memory(value);
    H5Tclose(type);
    H5Aclose(handle);
    checked(status, attribute);
    return result;
  }

 private:
  template <typename Id>
  static Id checked(Id id, const std::string& what) {
    if (id < 0) throw std::runtime_error("cannot read " + what);
    return id;
  }

  hid_t open(const std::string& id, const std::string& attribute) const {
    return checked(H5Aopen_by_name(file_, id.c_str(), attribute.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                   attribute);
  }

  std::vector<double> read(const std::string& name, std::vector<hsize_t>& shape) const {
    const hid_t dataset = checked(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), name);
    const hid_t space = H5Dget_space(dataset);
    shape.resize(H5Sget_simple_extent_ndims(space));
    H5Sget_simple_extent_dims(space, shape.data(), nullptr);
    std::vector<double> values(H5Sget_simple_extent_npoints(space));
    if (!values.empty()) {
      checked(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name);
    }
    H5Sclose(space);
    H5Dclose(dataset);
    return values;
  }

  hid_t file_;
};

struct Outcome {
  int exit_code = -1;
  std::string output, errors;
};

/// A directory in which the program runs.
class Workplace : public ddem::test::WorkFolder {
 public:
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path() / name, std::ios::binary) << text;
  }

  std::string read(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(path() / name, std::ios::binary).rdbuf();
    return text.str();
  }

  std::size_t file_count() const {
    const std::filesystem::directory_iterator files(path());
    return static_cast<std::size_t>(std::distance(begin(files), end(files)));
  }

  /// Runs ddem-fem in the folder with arguments as a shell takes them, under `launcher`.
  Outcome run(const std::string& arguments, const std::string& launcher = "") const {
    const std::string command =
        "cd '" + path().string() + "' && " + launcher + "'" DDEM_FEM_PROGRAM "' " + arguments + " > .output 2> .errors";
    const int status = std::system(command.c_str());
    Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(".output"), read(".errors")};
    std::filesystem::remove(path() / ".output");
    std::filesystem::remove(path() / ".errors");
    return outcome;
  }
};

}  // namespace ddem::fem::test
