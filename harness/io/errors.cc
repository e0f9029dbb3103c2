#include "harness/io/errors.h"

#include <sys/resource.h>

#include <cerrno>
#include <new>
#include <system_error>
#include <utility>

namespace ddem::harness {
namespace {

std::string joined(const std::vector<std::string>& messages) {
  std::string all;
  for (const std::string& message : messages) {
    if (!all.empty()) all += '\n';
    all += message;
  }
  return all;
}

/// Of a file that is too large: what allows no larger one. Empty for other errors, and where it is the file system.
std::string limit_text(int error_number) {
  rlimit limit{};
  if (error_number != EFBIG || ::getrlimit(RLIMIT_FSIZE, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return "";
  return " (this process may write files of " + std::to_string(limit.rlim_cur) + " bytes: ulimit -f)";
}

}  // namespace

InputError::InputError(std::vector<std::string> messages)
    : std::runtime_error(joined(messages)), messages_(std::move(messages)) {}

InputError::InputError(std::string message) : InputError(std::vector<std::string>{std::move(message)}) {}

MachineError machine_error(const std::string& path, const std::string& what, int error_number) {
  return MachineError(path + ": " + what + ": " + std::generic_category().message(error_number) + limit_text(error_number));
}

ExitCode exit_code_of(const std::exception& error) {
  const auto is = [&]<class T>() { return dynamic_cast<const T*>(&error) != nullptr; };
  if (is.operator()<InputError>() || is.operator()<std::invalid_argument>()) return ExitCode::wrong_input;
  if (is.operator()<SolverError>()) return ExitCode::solver_failed;
  if (is.operator()<MachineError>() || is.operator()<std::system_error>() || is.operator()<std::bad_alloc>())
    return ExitCode::machine_failed;
  return ExitCode::solver_failed;
}

}  // namespace ddem::harness
