#pragma once
// Plain data to and from JSON: every member that DDEM_MEMBERS names, every number as it is. For .cc files only: it is long to
// compile.

#include <Eigen/Core>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <vector>

#include "harness/io/members.h"

namespace ddem::harness {

struct AnyVisit {
  template <class Member>
  void operator()(const char*, Member&) const;
};

template <class T>
concept HasMembers = requires(T& value) { visit_members(value, AnyVisit{}); };

template <class E>
concept StoredEnum = std::is_enum_v<E> && requires(E value) { last_enumerator(value); };

}  // namespace ddem::harness

namespace nlohmann {

template <ddem::harness::HasMembers T>
struct adl_serializer<T> {
  static void to_json(json& j, const T& data) {
    j = json::object();
    visit_members(data, [&j](const char* name, const auto& member) { j[name] = member; });
  }
  static void from_json(const json& j, T& data) {
    visit_members(data, [&j](const char* name, auto& member) { j.at(name).get_to(member); });
  }
};

/// null: empty.
template <class T>
struct adl_serializer<std::optional<T>> {
  static void to_json(json& j, const std::optional<T>& value) {
    if (value)
      j = *value;
    else
      j = nullptr;
  }
  static void from_json(const json& j, std::optional<T>& value) {
    if (j.is_null())
      value.reset();
    else
      value = j.template get<T>();
  }
};

template <ddem::harness::StoredEnum E>
struct adl_serializer<E> {
  static void to_json(json& j, E value) { j = static_cast<int>(value); }
  static void from_json(const json& j, E& value) {
    const auto number = j.template get<std::int64_t>();
    if (number < 0 || number > static_cast<std::int64_t>(last_enumerator(E{})))
      throw std::invalid_argument("a number that stands for nothing");
    value = static_cast<E>(number);
  }
};

/// {rows, columns, values by rows}.
template <int rows, int columns>
struct adl_serializer<Eigen::Matrix<double, rows, columns>> {
  using Matrix = Eigen::Matrix<double, rows, columns>;

  static void to_json(json& j, const Matrix& m) {
    std::vector<double> values;
    for (Eigen::Index r = 0; r < m.rows(); ++r) {
      for (Eigen::Index c = 0; c < m.cols(); ++c) values.push_back(m(r, c));
    }
    j = json{{"rows", m.rows()}, {"columns", m.cols()}, {"values", values}};
  }
  static void from_json(const json& j, Matrix& m) {
    const auto values = j.at("values").template get<std::vector<double>>();
    const auto r = j.at("rows").template get<Eigen::Index>(), c = j.at("columns").template get<Eigen::Index>();
    if (r < 0 || c < 0 || (r > 0 && static_cast<Eigen::Index>(values.size()) / r != c) ||
        static_cast<Eigen::Index>(values.size()) != r * c) {
      throw std::invalid_argument("a matrix whose size is not that of its values");
    }
    if ((rows != Eigen::Dynamic && r != rows) || (columns != Eigen::Dynamic && c != columns))
      throw std::invalid_argument("a matrix of another size");
    m.resize(r, c);
    for (Eigen::Index k = 0; k < r * c; ++k) m(k / c, k % c) = values[static_cast<std::size_t>(k)];
  }
};

}  // namespace nlohmann
