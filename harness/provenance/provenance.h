#pragma once
// Which program on which machine made a result.

#include <string>
#include <utility>
#include <vector>

namespace ddem::harness {

/// Pairs of name and value: version, compiler, flags, libraries, processor, instruction set, host's cores, time (UTC).
std::vector<std::pair<std::string, std::string>> provenance();

/// What `--version` prints.
std::string version_text();

}  // namespace ddem::harness
