#include "harness/cli/print_json.h"

#include <fmt/format.h>

namespace ddem::harness {
namespace {

bool printed = false;  // a command prints one document

const char* status_of(ExitCode code) {
  switch (code) {
    case ExitCode::done: return "ok";
    case ExitCode::verdict_failed: return "failed";
    case ExitCode::wrong_input: return "wrong input";
    case ExitCode::solver_failed: return "solver failed";
    case ExitCode::machine_failed: return "machine failed";
  }
  return "failed";
}

}  // namespace

void print_json(const Json& result) {
  fmt::print("{}", to_text(result));
  printed = true;
}

void print_json_failure(ExitCode code, const std::vector<std::string>& messages) {
  if (!printed) print_json({{"status", status_of(code)}, {"exit_code", static_cast<int>(code)}, {"messages", messages}});
}

std::vector<std::string> messages_of(const std::exception& error) {
  if (const auto* input = dynamic_cast<const InputError*>(&error)) return input->messages();
  return {error.what()};
}

}  // namespace ddem::harness
