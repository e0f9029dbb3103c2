#pragma once
// What a case of the campaign is about, so that a reader of the report can filter by it.

#include <string>
#include <utility>
#include <vector>

namespace ddem::harness {

/// Of a case's id: {"check", "long-wave"}, {"packing", "random"}, {"scheme", "lagged-full"}; those that the
/// id names.
std::vector<std::pair<std::string, std::string>> facets_of(const std::string& case_id);

}  // namespace ddem::harness
