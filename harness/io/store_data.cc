#include "harness/io/store_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace ddem::harness {
namespace {

using nlohmann::json;

constexpr const char* kNone = "none";

bool are_numbers(const json& list) {
  return std::ranges::all_of(list, [](const json& v) { return v.is_number() || v.is_boolean(); });
}

bool are_texts(const json& list) {
  return std::ranges::all_of(list, [](const json& v) { return v.is_string(); });
}

double number(const json& v) {
  return v.is_boolean() ? static_cast<double>(v.get<bool>()) : v.get<double>();
}

/// As data_json.h writes one.
bool is_matrix(const json& v) { return v.size() == 3 && v.contains("rows") && v.contains("columns") && v.contains("values"); }

std::string name_of(std::string key) {
  std::replace(key.begin(), key.end(), '/', ':');
  return key;
}

/// Whether each row's value of a member can stand in one dataset.
bool is_column(const json& rows, const std::string& member) {
  const json& first = rows.front().at(member);
  const auto is_value = [](const json& v) { return v.is_number() || v.is_boolean() || v.is_null(); };
  if (first.is_string()) return std::ranges::all_of(rows, [&](const json& r) { return r.at(member).is_string(); });
  if (!first.is_array()) return std::ranges::all_of(rows, [&](const json& r) { return is_value(r.at(member)); });
  return !first.empty() && std::ranges::all_of(rows, [&](const json& r) {
    const json& v = r.at(member);
    return v.is_array() && v.size() == first.size() && are_numbers(v);
  });
}

bool are_alike(const json& rows) {
  const json& first = rows.front();
  if (!std::ranges::all_of(rows, [&](const json& r) { return r.is_object() && r.size() == first.size(); })) return false;
  for (const auto& [member, value] : first.items()) {
    if (!std::ranges::all_of(rows, [&, &m = member](const json& r) { return r.contains(m); }) || !is_column(rows, member)) return false;
  }
  return true;
}

void store_column(Hdf5Group& group, const json& rows, const std::string& member) {
  const json& first = rows.front().at(member);
  std::vector<double> values;
  std::vector<std::string> texts, status;
  for (const json& row : rows) {
    const json& v = row.at(member);
    if (v.is_array()) {
      for (const json& item : v) values.push_back(number(item));
    } else if (v.is_string()) {
      texts.push_back(v.get<std::string>());
    } else {
      values.push_back(v.is_null() ? 0.0 : number(v));
      status.emplace_back(v.is_null() ? kNone : "ok");
    }
  }
  const bool some_none = std::find(status.begin(), status.end(), kNone) != status.end();
  if (first.is_array()) group.write(member, values, {rows.size(), first.size()});
  else if (first.is_string()) group.write(member, texts);
  else group.write(member, values);
  if (some_none) group.write(member + "_status", status);
}

void store_list(Hdf5Group& parent, const std::string& name, const json& list) {
  if (are_numbers(list)) {
    std::vector<double> values;
    for (const json& v : list) values.push_back(number(v));
    parent.write(name, values);
  } else if (are_texts(list)) {
    parent.write(name, list.get<std::vector<std::string>>());
  } else {
    Hdf5Group group = parent.create_group(name);
    if (are_alike(list)) {
      for (const auto& [member, value] : list.front().items()) store_column(group, list, member);
      return;
    }
    json by_place = json::object();
    for (std::size_t n = 0; n < list.size(); ++n) by_place[fmt::format("{:04d}", n)] = list[n];
    store_data(group, by_place);
  }
}

}  // namespace

void store_data(Hdf5Group& group, const json& data) {
  for (const auto& [key, value] : data.items()) {
    const std::string name = name_of(key);
    if (value.is_null()) {
      group.set_attribute(name + "_status", kNone);
    } else if (value.is_string()) {
      if (!value.get_ref<const std::string&>().empty()) group.set_attribute(name, value.get<std::string>());
    } else if (value.is_number_integer() || value.is_boolean()) {
      group.set_attribute(name, value.is_boolean() ? std::int64_t{value.get<bool>()} : value.get<std::int64_t>());
    } else if (value.is_number()) {
      group.set_attribute(name, value.get<double>());
    } else if (value.is_array()) {
      if (!value.empty()) store_list(group, name, value);
    } else if (is_matrix(value)) {
      group.write(name, value.at("values").get<std::vector<double>>(), {value.at("rows").get<std::size_t>(), value.at("columns").get<std::size_t>()});
    } else if (!value.empty()) {
      Hdf5Group inside = group.create_group(name);
      store_data(inside, value);
    }
  }
}

}  // namespace ddem::harness
