#include "harness/studies/strip/read_strip.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "harness/io/data_json.h"
#include "harness/io/errors.h"
#include "harness/scene/nearest_name.h"
#include "harness/scene/read_scene.h"
#include "harness/scene/units.h"
#include "reports/number.h"
#include "reports/text.h"

namespace ddem::harness {
namespace {

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
    if (std::string size = magnitude_problem(*value, dimension); !size.empty()) return size;
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
      if (value == nullptr || reports::clean_utf8(*value) != *value) return "give a text without control characters";
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

/// What a scene of the strip cannot be: numbers that are right alone and impossible side by side. Of every model, packing and
/// wave at the ends of the ratios.
void add_problems_of_strip(const StripCampaign& s, const std::string& file, std::vector<std::string>& problems) {
  std::set<std::string> said;
  const auto check = [&](const StripCase& c) {
    constexpr double kAnySpeed = 2000.0;  // m/s: turns the pulse's length into a duration
    for (const Violation& v : parse_scene(scene_text(s, c, kAnySpeed), "[strip] as " + id_of(c), ".", {}).violations) {
      if (said.insert(v.key + v.message).second) problems.push_back(fmt::format("{}: {}", file, to_string(v)));
    }
  };
  for (const StripPacking packing : {StripPacking::hexagonal, StripPacking::random}) {
    for (const Model model : s.models) {
      for (const double ratio : {s.stiffness_ratios.front(), s.stiffness_ratios.back()}) {
        for (const Protocol protocol : {Protocol::long_wave, Protocol::paper}) {
          for (const StripWave wave : {StripWave::bar, StripWave::shear, StripWave::p}) check({packing, s.seeds.front(), model, ratio, protocol, wave});
        }
      }
    }
  }
}

/// As a campaign file would say it.
std::string toml_of(const StripCampaign& s) {
  std::vector<std::string> models;
  for (const Model m : s.models) models.push_back(material_slug(m, 0.0).substr(0, material_slug(m, 0.0).find('/')));
  return fmt::format("[strip]\nstiffness_ratios = [{}]\nmodels = [\"{}\"]\nseeds = [{}]\nlength = {}\nwidth = {}\ndiscs = {}\n"
                     "columns = {}\nrows = {}\ncoordination = {}\ndensity = {}\nnormal_stiffness = {}\nparticle_modulus = {}\n"
                     "particle_poisson_ratio = {}\nstep_fraction = {}\nlong_wave_step_fraction = {}\npulse_length = {}\n"
                     "fem_degree = {}\n",
                     fmt::join(s.stiffness_ratios, ", "), fmt::join(models, "\", \""), fmt::join(s.seeds, ", "), s.length, s.width,
                     s.discs, s.columns, s.rows, s.coordination, s.density, s.normal_stiffness, s.particle_modulus,
                     s.particle_poisson_ratio, s.step_fraction, s.long_wave_step_fraction, s.pulse_length, s.fem_degree);
}

}  // namespace

nlohmann::json read_strip(const Document& document, const std::filesystem::path& path, std::vector<std::string>& problems) {
  StripCampaign strip;
  const auto known = setters(strip);
  const std::size_t before = problems.size();
  std::vector<std::string_view> names;
  for (const auto& [key, setter] : known) names.push_back(key);
  const auto report = [&](const Entry& e, const std::string& message, const std::string& remedy) {
    problems.push_back(to_string(Violation{path.string(), e.node.line, 0, "strip." + e.key, e.node.text, message, remedy}));
  };
  for (const Entry& entry : document.entries) {
    if (entry.table != "strip") continue;
    const auto setter = known.find(entry.key);
    if (setter == known.end()) {
      const auto near = nearest_name(entry.key, names);
      report(entry, "unknown key", near ? fmt::format("did you mean {}?", *near) : fmt::format("the keys are {}", fmt::join(names, ", ")));
    } else if (const std::string remedy = setter->second(entry.node); !remedy.empty()) {
      report(entry, "not a value of this key", remedy);
    }
  }
  if (strip.rows % 2 != 0) {
    problems.push_back(fmt::format("{}: strip.rows = {}: an odd number of rows does not close periodically; give an even one", path.string(), strip.rows));
  }
  if (problems.size() == before) add_problems_of_strip(strip, path.string(), problems);
  return strip;
}

void check_strip(const nlohmann::json& data) {
  std::vector<std::string> problems;
  read_strip(*parse_document(toml_of(data.get<StripCampaign>()), "plan.json"), "plan.json", problems);
  if (!problems.empty()) throw InputError(problems);
}

/// Members that are lists of what is varied may grow; the others are the strip.
std::string lost_of_strip(const nlohmann::json& there, const nlohmann::json& here) {
  for (const auto& [key, value] : there.items()) {
    const nlohmann::json now = here.is_object() && here.contains(key) ? here.at(key) : nlohmann::json();
    if (key == "title" || (key == "full_stability" && value != true) || now == value) continue;
    const bool may_grow = key == "models" || key == "stiffness_ratios";
    const auto stays = [&now](const nlohmann::json& item) { return std::find(now.begin(), now.end(), item) != now.end(); };
    if (may_grow && now.is_array() && std::all_of(value.begin(), value.end(), stays)) continue;
    return fmt::format("strip.{} = {}, and this run has {}", key, value.dump(), now.dump());
  }
  return "";
}

nlohmann::json default_strip() {
  return StripCampaign{};
}

void introduce_strip(const nlohmann::json& data, reports::Report& report) {
  const auto s = data.get<StripCampaign>();
  report.title = s.title;
  report.summary = {
      fmt::format("Strips of {:g} mm × {:g} mm: {} random discs (coordination {:g}, seeds {}) and a hexagonal lattice of {} × {}; "
                  "disc density {:g} kg/m³, kₙ = {} N/m, kₙ/Eₚ = {:g}, νₚ = {:g}. DDEM N and F are the published "
                  "scheme, in which the strains of the discs come from the forces of the step before: N corrects normal overlaps, "
                  "as published; F corrects both and derives from an energy. F implicit takes strains and forces of the same step.",
                  s.length * 1e3, s.width * 1e3, s.discs, s.coordination, fmt::join(s.seeds, ", "), s.columns, s.rows, s.density,
                  reports::number_text(s.normal_stiffness), s.normal_stiffness / s.particle_modulus, s.particle_poisson_ratio)};
  report.provenance.emplace_back("seeds", fmt::format("{}", fmt::join(s.seeds, ", ")));
}

CampaignSpec campaign_of(const StripCampaign& strip) {
  CampaignSpec spec;
  spec.tables["strip"] = strip;
  return spec;
}

StripCampaign strip_in(const CampaignSpec& spec) {
  return spec.tables.at("strip").get<StripCampaign>();
}

}  // namespace ddem::harness
