#pragma once
// The members of a scene that a key fills stand in the key's row: into<&Contact::stiffness_ratio>(number("contact", ...)).

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <typeinfo>

#include "dem/core/narrow.h"
#include "harness/scene/keys.h"
#include "harness/scene/values.h"

namespace ddem::harness {

/// By the member's own type.
template <class Member>
void assign(Member& member, const Values& values, std::string_view dotted) {
  if constexpr (std::is_enum_v<Member>) member = values.choice<Member>(dotted);
  else if constexpr (std::same_as<Member, bool>) member = values.flag(dotted);
  else if constexpr (std::same_as<Member, int>) member = narrow<int>(values.integer(dotted), std::string(dotted).c_str());
  else if constexpr (std::same_as<Member, std::int64_t>) member = values.integer(dotted);
  else if constexpr (std::same_as<Member, double>) member = values.number(dotted);
  else if constexpr (std::same_as<Member, std::string>) member = values.text(dotted);
  else if constexpr (std::same_as<Member, std::filesystem::path>) member = values.file(dotted);
  else assign(member.emplace(), values, dotted);  // an optional one
}

template <class Owner, class Member>
void fill_one(Member Owner::*member, const std::type_info& owner, void* table, const Values& values, std::string_view dotted) {
  if (owner == typeid(Owner)) assign(static_cast<Owner*>(table)->*member, values, dotted);
}

template <auto... members>
constexpr KeySpec into(KeySpec row) {
  row.fill = [](const std::type_info& owner, void* table, const Values& values, std::string_view dotted) {
    (fill_one(members, owner, table, values, dotted), ...);
  };
  return row;
}

/// A table with what is written or stands by default; members without a value keep theirs.
template <class Table>
Table filled(const Values& values, std::string_view table) {
  Table out;
  for (const KeySpec& spec : scene_keys()) {
    const std::string dotted = dotted_name(spec.table, spec.key);
    if (spec.table == table && spec.fill != nullptr && values.has(dotted)) spec.fill(typeid(Table), &out, values, dotted);
  }
  return out;
}

}  // namespace ddem::harness
