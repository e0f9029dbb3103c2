#pragma once
// Whether the parts of a result that was read from a file fit each other: std::runtime_error says which do not.

#include <set>
#include <string>

#include "dem/core/packing.h"

namespace ddem::harness {

void require(bool holds, const std::string& what);
void require_length(const std::string& what, std::size_t actual, std::size_t expected);
void require_whole(const ddem::Packing& packing);

/// Names of groups in a file of results.
class GroupNames {
 public:
  /// Throws where it is no name, or there is one already.
  void add(const std::string& name);

 private:
  std::set<std::string> names_;
};

}  // namespace ddem::harness
