#pragma once
// What went wrong, in the classes that users see as exit codes.

#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

namespace ddem::harness {

enum class ExitCode {
  done = 0,            ///< within tolerance
  verdict_failed = 1,  ///< a validation verdict failed
  wrong_input = 2,     ///< wrong use or wrong input
  solver_failed = 3,   ///< unstable, NaN, no convergence
  machine_failed = 4,  ///< disk, permissions, missing tool
};

/// Wrong use or wrong input. All problems at once, one message each; what() joins them by line breaks.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<std::string> messages);
  explicit InputError(std::string message);

  const std::vector<std::string>& messages() const { return messages_; }

 private:
  std::vector<std::string> messages_;
};

/// What is asked for is beyond what a solver can do.
class UnsupportedError : public InputError {
 public:
  using InputError::InputError;
};

/// A numerical failure; the message names the step and the particle.
class SolverError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The disk, permissions, a missing tool.
class MachineError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// "PATH: what: strerror(error_number)" as a MachineError; of a file that is too large with the limit, where it is the process's.
MachineError machine_error(const std::string& path, const std::string& what, int error_number);

/// The exit code that an exception asks for. Those of the libraries below us: std::invalid_argument is wrong
/// input; std::bad_alloc and std::system_error are the machine's; any other std::runtime_error is a solver's
/// failure.
ExitCode exit_code_of(const std::exception& error);

}  // namespace ddem::harness
