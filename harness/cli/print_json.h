#pragma once
// --json: every command that is asked for JSON prints one document, whatever happens.

#include <exception>
#include <string>
#include <vector>

#include "harness/io/errors.h"
#include "harness/io/json.h"

namespace ddem::harness {

/// A command's result, on standard output.
void print_json(const Json& result);

/// What ended a command without a result: {"status": "wrong input", "exit_code": 2, "messages": [...]}. Nothing where a result
/// has been printed, such as that of a run that diverged.
void print_json_failure(ExitCode code, const std::vector<std::string>& messages);

/// The messages of an exception: all problems of an input, else its text.
std::vector<std::string> messages_of(const std::exception& error);

}  // namespace ddem::harness
