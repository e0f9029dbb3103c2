#pragma once
// Processes that a program has left behind, whatever group or session they have moved to.

#include <string>

namespace ddem::harness {

/// Kills every process of this user in whose first environment "NAME=VALUE" stands, and those that appear meanwhile.
void kill_marked(const std::string& mark);

}  // namespace ddem::harness
