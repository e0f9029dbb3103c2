#include "harness/scene/read_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <system_error>
#include <utility>

#include "harness/scene/nearest_name.h"

namespace ddem::harness {
namespace {

ReadValue problem(std::string message, const KeySpec& spec) {
  return {{}, std::move(message), "write " + describe_value(spec)};
}

std::string_view type_name(const Node& node) {
  if (const auto* other = std::get_if<Unsupported>(&node.value)) return other->name;
  constexpr std::string_view names[] = {"", "true or false", "a whole number", "a number", "text", "a list"};
  return names[node.value.index()];
}

ReadValue wrong_type(const Node& node, const KeySpec& spec) {
  return problem(fmt::format("wrong type: this is {}", type_name(node)), spec);
}

// A finite number in SI units within the row's range, or a problem.
struct ReadNumber {
  std::optional<double> si;
  std::string problem;
};

ReadNumber read_number(const Node& node, const KeySpec& spec) {
  Quantity quantity;
  if (const auto* number = std::get_if<double>(&node.value)) {
    quantity.si = *number;
  } else if (const auto* integer = std::get_if<std::int64_t>(&node.value)) {
    quantity.si = static_cast<double>(*integer);
  } else if (const auto* text = std::get_if<std::string>(&node.value);
             text && spec.dimension != Dimension::none) {
    quantity = parse_quantity(*text, spec.dimension);
  } else {
    return {{}, fmt::format("wrong type: this is {}", type_name(node))};
  }
  if (!quantity.si) return {{}, quantity.problem};
  if (!std::isfinite(*quantity.si)) return {{}, "not a finite number"};
  if (!spec.range.contains(*quantity.si)) return {{}, fmt::format("must be {}", describe(spec.range))};
  if (std::string size = magnitude_problem(*quantity.si, spec.dimension); !size.empty()) return {{}, std::move(size)};
  return {quantity.si, {}};
}

ReadValue read_integer(const Node& node, const KeySpec& spec) {
  const auto* integer = std::get_if<std::int64_t>(&node.value);
  if (!integer) return wrong_type(node, spec);
  if (!spec.range.contains(static_cast<double>(*integer))) {
    return problem(fmt::format("must be {}", describe(spec.range)), spec);
  }
  return {*integer, {}, {}};
}

ReadValue read_choice(const Node& node, const KeySpec& spec) {
  const auto* text = std::get_if<std::string>(&node.value);
  if (!text) return wrong_type(node, spec);
  const std::vector<std::string_view> names = split_names(spec.choices);
  const auto found = std::find(names.begin(), names.end(), *text);
  if (found != names.end()) return {Choice{static_cast<int>(found - names.begin()), *found}, {}, {}};
  ReadValue unknown = problem("not one of the choices", spec);
  const auto nearest = nearest_name(*text, names);
  if (nearest && !nearest->empty()) unknown.remedy += fmt::format("; did you mean \"{}\"?", *nearest);
  return unknown;
}

ReadValue read_file(const Node& node, const KeySpec& spec, const std::filesystem::path& base_folder, FileCheck check) {
  const auto* text = std::get_if<std::string>(&node.value);
  if (!text) return wrong_type(node, spec);
  if (text->empty() || text->find('\0') != std::string::npos) return problem("not the name of a file", spec);
  const std::filesystem::path path = base_folder / *text;
  if (check == FileCheck::name) return {path, {}, {}};
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  const auto missing = [&](std::string message) {
    return ReadValue{{}, std::move(message), "paths are relative to the folder of the scene file"};
  };
  if (status.type() == std::filesystem::file_type::not_found)
    return missing("there is no file " + path.string());
  if (error) return missing(fmt::format("{}: {}", error.message(), path.string()));
  if (std::filesystem::is_directory(status)) return missing(path.string() + " is a folder, not a file");
  if (!std::filesystem::is_regular_file(status)) {
    return {{}, path.string() + " is a device or a pipe, not a file", "write what comes out of it to a file, and name that"};
  }
  return {path, {}, {}};
}

// Lists of whole numbers: two counts, or the indices of different discs.
ReadValue read_integers(const Node& node, const KeySpec& spec) {
  const auto* list = std::get_if<Node::List>(&node.value);
  if (!list) return wrong_type(node, spec);
  if (spec.type == ValueType::counts && list->size() != 2) {
    return problem(fmt::format("{} members instead of 2", list->size()), spec);
  }
  if (list->empty()) return problem("an empty list", spec);
  std::vector<std::int64_t> integers;
  std::set<std::int64_t> seen;
  for (std::size_t k = 0; k < list->size(); ++k) {
    ReadValue member = read_integer((*list)[k], spec);
    const auto* integer = std::get_if<std::int64_t>(&member.value);
    if (!integer) return problem(fmt::format("member {}: {}", k + 1, member.message), spec);
    if (spec.type == ValueType::indices && !seen.insert(*integer).second) {
      return problem(fmt::format("{} is there twice", *integer), spec);
    }
    integers.push_back(*integer);
  }
  return {std::move(integers), {}, {}};
}

ReadValue read_points(const Node& node, const KeySpec& spec) {
  const auto* list = std::get_if<Node::List>(&node.value);
  if (!list) return wrong_type(node, spec);
  if (list->empty()) return problem("an empty list", spec);
  std::vector<Point> points;
  for (std::size_t k = 0; k < list->size(); ++k) {
    const auto* pair = std::get_if<Node::List>(&(*list)[k].value);
    if (!pair || pair->size() != 2) return problem(fmt::format("member {} is not [x, y]", k + 1), spec);
    const ReadNumber x = read_number((*pair)[0], spec);
    const ReadNumber y = read_number((*pair)[1], spec);
    if (!x.si || !y.si)
      return problem(fmt::format("member {}: {}", k + 1, x.si ? y.problem : x.problem), spec);
    points.push_back({*x.si, *y.si});
  }
  return {std::move(points), {}, {}};
}

}  // namespace

ReadValue read_value(const Node& node, const KeySpec& spec, const std::filesystem::path& base_folder, FileCheck check) {
  switch (spec.type) {
    case ValueType::text: {
      const auto* text = std::get_if<std::string>(&node.value);
      return text ? ReadValue{*text, {}, {}} : wrong_type(node, spec);
    }
    case ValueType::boolean: {
      const auto* flag = std::get_if<bool>(&node.value);
      return flag ? ReadValue{*flag, {}, {}} : wrong_type(node, spec);
    }
    case ValueType::number: {
      const ReadNumber number = read_number(node, spec);
      return number.si ? ReadValue{*number.si, {}, {}} : problem(number.problem, spec);
    }
    case ValueType::file:
      return read_file(node, spec, base_folder, check);
    case ValueType::choice:
      return read_choice(node, spec);
    case ValueType::integer:
      return read_integer(node, spec);
    case ValueType::counts:
    case ValueType::indices:
      return read_integers(node, spec);
    case ValueType::points:
      return read_points(node, spec);
  }
  return {};
}

}  // namespace ddem::harness
