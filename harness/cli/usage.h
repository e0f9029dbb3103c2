#pragma once
// What every command line has in common: no empty values, and help with slips.

#include <CLI/CLI.hpp>
#include <string>

namespace ddem::harness {

/// Every option and argument of the program and its commands refuses an empty or blank text: it would do nothing, or name nothing.
void refuse_empty_values(CLI::App& app);

/// What a command line that was not understood probably meant: "rum: unknown command; did you mean run?". Empty where the
/// library's own message says all.
std::string explain_slip(const CLI::App& app, int argc, const char* const* argv);

}  // namespace ddem::harness
