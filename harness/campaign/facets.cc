#include "harness/campaign/facets.h"

#include <algorithm>
#include <string_view>

namespace ddem::harness {

std::vector<std::pair<std::string, std::string>> facets_of(const std::string& case_id) {
  std::vector<std::pair<std::string, std::string>> facets;
  std::string_view rest = case_id;
  for (bool first = true; !rest.empty(); first = false) {
    const std::string_view part = rest.substr(0, rest.find('/'));
    rest.remove_prefix(std::min(rest.size(), part.size() + 1));
    if (first)
      facets.emplace_back("check", part);
    else if (part == "random" || part == "hexagonal")
      facets.emplace_back("packing", part);
    else if (part == "dem" || part.starts_with("lagged-") || part.starts_with("implicit-"))
      facets.emplace_back("scheme", part);
  }
  return facets;
}

}  // namespace ddem::harness
