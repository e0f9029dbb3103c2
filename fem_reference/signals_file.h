#pragma once
// The signals file: HDF5, one group a case.
//   time (n), points (n x npoints x 2), sections (n x nsections x 2): doubles, SI units
//   fields, a group, only of cases with snapshots: x, y (points), quadrilaterals (count x 4, of points, anticlockwise),
//   time (snapshots), displacement_x, displacement_y, velocity_x, velocity_y, strain_xx, strain_yy, strain_xy, stress_xx, stress_yy,
//   stress_xy (snapshots x points; xy of strain is the tensor's)
//   attributes of the group: degree, elements (2; of a user's mesh: all, and 1), element_count, dofs, steps: integers;
//   critical_time_step, time_step, sample_interval, solve_seconds, energy_drift (only if it could be measured): doubles; status: text
//   attributes of the file: schema = 1, program: text
// Text is of variable length, UTF-8. deal.II's own classes for HDF5 check for errors in debug mode only; a
// full disk must not pass unseen, so this is the C interface.

#include <filesystem>
#include <memory>
#include <stdexcept>

#include "fem_reference/cases.h"
#include "fem_reference/run_case.h"

namespace ddem::fem {

/// The machine failed: disk, permissions.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws CaseError for a file that holds something else than HDF5: an input, or what is not ours.
void check_replaceable(const std::filesystem::path& target);

/// Written beside its target under another name; appears there, whole, with commit(), or leaves nothing
/// behind.
class SignalsFile {
 public:
  /// Throws FileError, as all of its functions do, here for a target that cannot be written.
  SignalsFile(const std::filesystem::path& target, const std::string& program);
  ~SignalsFile();
  SignalsFile(const SignalsFile&) = delete;
  SignalsFile& operator=(const SignalsFile&) = delete;

  void write(const StripCase& strip, const CaseResult& result);
  void commit();

 private:
  struct Open;
  std::filesystem::path target_;
  std::unique_ptr<Open> open_;
};

}  // namespace ddem::fem
