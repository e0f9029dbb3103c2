#include "harness/studies/strip/whole.h"

#include <fmt/format.h>

#include <stdexcept>

namespace ddem::harness {

void require(bool holds, const std::string& what) {
  if (!holds) throw std::runtime_error(what);
}

void require_length(const std::string& what, std::size_t actual, std::size_t expected) {
  require(actual == expected, fmt::format("{}: {} values, not {}", what, actual, expected));
}

void require_whole(const ddem::Packing& p) {
  require_length("y of discs", p.y.size(), p.x.size());
  require_length("radii of discs", p.radius.size(), p.x.size());
}

void GroupNames::add(const std::string& name) {
  require(!name.empty() && name != "." && name.find('/') == std::string::npos, "'" + name + "' is no name");
  require(names_.insert(name).second, "two results are called '" + name + "'");
}

}  // namespace ddem::harness
