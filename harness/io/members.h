#pragma once
// The members of plain data, named once, beside the type. JSON and CBOR (io/data_json.h), and HDF5 (io/store_data.h) follow.
//
//   struct Speeds { double bar = 0.0, shear = 0.0; };
//   DDEM_MEMBERS(Speeds, bar, shear)
//
// defines visit_members(speeds, visit), which calls visit("bar", speeds.bar), and so on. In the type's own namespace.

#include <concepts>
#include <type_traits>

#define DDEM_PARENTHESES ()
#define DDEM_RESCAN(...) DDEM_RESCAN_3(DDEM_RESCAN_3(DDEM_RESCAN_3(DDEM_RESCAN_3(__VA_ARGS__))))
#define DDEM_RESCAN_3(...) DDEM_RESCAN_2(DDEM_RESCAN_2(DDEM_RESCAN_2(DDEM_RESCAN_2(__VA_ARGS__))))
#define DDEM_RESCAN_2(...) DDEM_RESCAN_1(DDEM_RESCAN_1(DDEM_RESCAN_1(DDEM_RESCAN_1(__VA_ARGS__))))
#define DDEM_RESCAN_1(...) __VA_ARGS__
#define DDEM_VISIT(member, ...) \
  visit(#member, value.member); \
  __VA_OPT__(DDEM_VISIT_NEXT DDEM_PARENTHESES(__VA_ARGS__))
#define DDEM_VISIT_NEXT() DDEM_VISIT

#define DDEM_MEMBERS(Type, ...)                                                   \
  template <class Value, class Visit>                                             \
    requires std::same_as<std::remove_const_t<Value>, Type>                       \
  void visit_members(Value& value, const Visit& visit) {                          \
    DDEM_RESCAN(DDEM_VISIT(__VA_ARGS__))                                          \
  }

/// The enumerators up to `last` may come from a file; they are stored as numbers.
#define DDEM_LAST_ENUMERATOR(Enum, last) \
  constexpr Enum last_enumerator(Enum) { return Enum::last; }
