// Campaign files: [strip] and [[case]], every problem listed at once.
#include "harness/campaign/read_campaign.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

#include "harness/campaign/read_cases.h"
#include "harness/io/errors.h"
#include "harness/scene/document.h"
#include "harness/scene/nearest_name.h"
#include "harness/scene/text_file.h"
#include "harness/scene/units.h"

namespace ddem::harness {
namespace {

constexpr std::size_t kMostBytes = 1 << 20;

/// Sets a member from a node; returns what would be right, or nothing when all is well.
using Setter = std::function<std::string(const Node&)>;

std::optional<double> quantity(const Node& node, Dimension dimension) {
  if (const auto* d = std::get_if<double>(&node.value)) return *d;
  if (const auto* i = std::get_if<std::int64_t>(&node.value)) return static_cast<double>(*i);
  if (const auto* s = std::get_if<std::string>(&node.value)) return parse_quantity(*s, dimension).si;
  return std::nullopt;
}

Setter positive(double& member, Dimension dimension, double most = HUGE_VAL) {
  return [&member, dimension, most](const Node& node) -> std::string {
    const auto value = quantity(node, dimension);
    if (!value || !(*value > 0.0) || !(*value <= most) || !std::isfinite(*value)) {
      return fmt::format("give a {} greater than 0{}", dimension_name(dimension),
                         std::isfinite(most) ? fmt::format(" and at most {}", most) : "");
    }
    member = *value;
    return "";
  };
}

Setter integer(std::int64_t& member, std::int64_t low, std::int64_t high) {
  return [&member, low, high](const Node& node) -> std::string {
    const auto* value = std::get_if<std::int64_t>(&node.value);
    if (value == nullptr || *value < low || *value > high) return fmt::format("give a whole number from {} to {}", low, high);
    member = *value;
    return "";
  };
}

Setter yes_or_no(bool& member) {
  return [&member](const Node& node) -> std::string {
    const auto* value = std::get_if<bool>(&node.value);
    if (value == nullptr) return "give true or false";
    member = *value;
    return "";
  };
}

Setter ratios(std::vector<double>& member) {
  return [&member](const Node& node) -> std::string {
    const char* remedy = "give a list of different numbers from 0 to 1, such as [0.0, 0.5, 1.0]";
    const auto* list = std::get_if<Node::List>(&node.value);
    if (list == nullptr || list->empty()) return remedy;
    std::vector<double> values;
    for (const Node& item : *list) {
      const auto value = quantity(item, Dimension::none);
      if (!value || !(*value >= 0.0 && *value <= 1.0) || (!values.empty() && *value <= values.back())) return remedy;
      values.push_back(*value);
    }
    member = values;
    return "";
  };
}

Setter seeds(std::vector<std::int64_t>& member) {
  return [&member](const Node& node) -> std::string {
    const auto* list = std::get_if<Node::List>(&node.value);
    std::vector<std::int64_t> values;
    if (list != nullptr) {
      for (const Node& item : *list) {
        const auto* seed = std::get_if<std::int64_t>(&item.value);
        if (seed != nullptr && *seed >= 0 && (values.empty() || *seed > values.back())) values.push_back(*seed);
      }
    }
    if (values.size() < 2 || values.size() != list->size()) return "give at least two different seeds in ascending order, such as [1, 2, 3, 4]";
    member = values;
    return "";
  };
}

Setter models(std::vector<Model>& member) {
  return [&member](const Node& node) -> std::string {
    static const std::map<std::string, Model> kNames = {
        {"dem", Model::dem}, {"lagged-normal", Model::lagged_normal}, {"lagged-full", Model::lagged_full},
        {"implicit-full", Model::implicit_full}};
    const char* remedy = "give a list of \"dem\", \"lagged-normal\", \"lagged-full\", \"implicit-full\", each at most once";
    const auto* list = std::get_if<Node::List>(&node.value);
    if (list == nullptr || list->empty()) return remedy;
    std::vector<Model> values;
    for (const Node& item : *list) {
      const auto* text = std::get_if<std::string>(&item.value);
      const auto found = text == nullptr ? kNames.end() : kNames.find(*text);
      if (found == kNames.end()) return remedy;
      for (const Model m : values) {
        if (m == found->second) return remedy;
      }
      values.push_back(found->second);
    }
    member = values;
    return "";
  };
}

std::map<std::string, Setter> setters(StripCampaign& c) {
  const auto text = [](std::string& member) -> Setter {
    return [&member](const Node& node) -> std::string {
      const auto* value = std::get_if<std::string>(&node.value);
      if (value == nullptr) return "give a text";
      member = *value;
      return "";
    };
  };
  return {{"title", text(c.title)},
          {"stiffness_ratios", ratios(c.stiffness_ratios)},
          {"models", models(c.models)},
          {"seeds", seeds(c.seeds)},
          {"length", positive(c.length, Dimension::length)},
          {"width", positive(c.width, Dimension::length)},
          {"discs", integer(c.discs, 200, 100000)},
          {"columns", integer(c.columns, 40, 100000)},
          {"rows", integer(c.rows, 4, 10000)},
          {"coordination", positive(c.coordination, Dimension::none, 6.0)},
          {"density", positive(c.density, Dimension::density)},
          {"normal_stiffness", positive(c.normal_stiffness, Dimension::stiffness)},
          {"particle_modulus", positive(c.particle_modulus, Dimension::stress)},
          {"particle_poisson_ratio", positive(c.particle_poisson_ratio, Dimension::none, 0.99)},
          {"step_fraction", positive(c.step_fraction, Dimension::none, 1.0)},
          {"long_wave_step_fraction", positive(c.long_wave_step_fraction, Dimension::none, 1.0)},
          {"pulse_length", positive(c.pulse_length, Dimension::length)},
          {"fem_degree", integer(c.fem_degree, 1, 8)},
          {"full_stability", yes_or_no(c.full_stability)}};
}

}  // namespace

CampaignFile read_campaign(const std::filesystem::path& path) {
  const auto text = read_text_file(path, kMostBytes);
  if (!text) throw InputError(to_string(text.violations));
  return parse_campaign(*text, path);
}

CampaignFile parse_campaign(std::string_view text, const std::filesystem::path& path) {
  CampaignFile campaign;
  const std::string file = path.string();
  const auto document = parse_document(text, file);
  if (!document) throw InputError(to_string(document.violations));

  const auto known = setters(campaign.strip);
  std::vector<std::string_view> names;
  for (const auto& [key, setter] : known) names.push_back(key);
  std::vector<std::string> problems;
  const auto report = [&](int line, const std::string& key, const std::string& value, const std::string& message, const std::string& remedy) {
    problems.push_back(to_string(Violation{file, line, 0, key, value, message, remedy}));
  };
  bool has_strip = false, has_cases = false;
  for (const TableHeader& table : document->tables) {
    if (table.name == "strip") has_strip = true;
    else report(table.line, table.name, "", "unknown table", "a campaign has [strip], and [[case]] for scenes of your own");
  }
  for (const Element& element : document->elements) {
    if (element.name == "case") has_cases = true;
    else report(element.line, element.name, "", "unknown table", "a campaign has [strip], and [[case]] for scenes of your own");
  }
  for (const Entry& entry : document->entries) {
    if (entry.table != "strip") {
      const bool array = std::any_of(document->elements.begin(), document->elements.end(),
                                     [&](const Element& e) { return e.name == entry.key; });
      if (entry.table.empty() && !array) {
        report(entry.node.line, entry.key, entry.node.text, "stands outside of [strip]", "move it below [strip]");
      }
      continue;
    }
    const auto setter = known.find(entry.key);
    const std::string key = "strip." + entry.key;
    if (setter == known.end()) {
      const auto near = nearest_name(entry.key, names);
      report(entry.node.line, key, entry.node.text, "unknown key",
             near ? fmt::format("did you mean {}?", *near) : fmt::format("the keys are {}", fmt::join(names, ", ")));
    } else if (const std::string remedy = setter->second(entry.node); !remedy.empty()) {
      report(entry.node.line, key, entry.node.text, "not a value of this key", remedy);
    }
  }
  if (campaign.strip.rows % 2 != 0) {
    problems.push_back(fmt::format("{}: strip.rows = {}: an odd number of rows does not close periodically; give an even one", file,
                                   campaign.strip.rows));
  }
  campaign.cases = read_cases(*document, path, problems);
  campaign.has_strip = has_strip || !has_cases;
  if (!problems.empty()) throw InputError(problems);
  return campaign;
}

StripCampaign read_strip_campaign(const std::filesystem::path& path) { return read_campaign(path).strip; }

}  // namespace ddem::harness
