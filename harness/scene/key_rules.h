#pragma once
// Which keys of a scene mean something beside which others, in one table: the check refuses what means nothing, the
// reference says so, and a test tries all pairs. A new key that does nothing beside some other is a row in key_rules.cc.

#include <span>
#include <string>
#include <string_view>

#include "harness/scene/keys.h"

namespace ddem::harness {

// Lists of keys and of values are written as in KeySpec::choices.

/// Keys that mean nothing unless `selector` has one of these values.
struct OnlyWith {
  std::string_view keys, selector, choices;
};

/// Keys as they stand in a scene: with one of `values`, or without such a list whatever their values are.
struct KeysWith {
  std::string_view keys, values{};
};

/// Beside `first`, what is written of `second` contradicts it, or means nothing.
struct Exclusion {
  KeysWith first, second;
  std::string_view message{};  ///< empty: that it contradicts the first
  std::string_view remedy = "give one of the two";
};

std::span<const OnlyWith> only_with_rules();
std::span<const Exclusion> exclusions();

/// `only with assembly.packing = "random"; not beside assembly.bonds`; empty for a key that goes with all others.
std::string describe_rules(const KeySpec& spec);

/// `"random" or "file"`.
std::string quoted_choices(std::string_view choices);

}  // namespace ddem::harness
