#pragma once
// Which program on which machine made a result.

#include <string>
#include <utility>
#include <vector>

namespace ddem::harness {

/// Pairs of name and value: version, commit, compiler, flags, libraries, processor, instruction set, host's cores, time (UTC).
std::vector<std::pair<std::string, std::string>> provenance();

/// The version and a digest of the running program and of ddem-fem beside it: of equal identity, and of equal inputs,
/// results are equal.
const std::string& program_identity();

/// What `--version` prints.
std::string version_text();

}  // namespace ddem::harness
