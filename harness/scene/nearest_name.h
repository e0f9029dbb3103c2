#pragma once
// "did you mean ...?"

#include <optional>
#include <span>
#include <string_view>

namespace ddem::harness {

/// Fewest insertions, deletions, replacements and swaps of neighbours that turn `a` into `b`.
int edit_distance(std::string_view a, std::string_view b);

/// The name closest to `written`, if one is so close that a slip of the keyboard explains it.
std::optional<std::string_view> nearest_name(std::string_view written,
                                             std::span<const std::string_view> names);

}  // namespace ddem::harness
