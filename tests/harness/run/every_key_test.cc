// Every key does something, or is refused with a reason: each alone in scenes of every kind, and beside each value of every
// other. Whether it does something is seen in what comes out: the motion, bit by bit, the moduli, the packing, the continuum.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>

#include "harness/io/errors.h"
#include "harness/model/assemble.h"
#include "harness/run/dem_run.h"
#include "harness/run/fem_plan.h"
#include "harness/run/scene_moduli.h"
#include "harness/scene/read_scene.h"
#include "tests/harness/run/key_values.h"

namespace ddem::harness::test {
namespace {

constexpr Purpose kPurposes[] = {Purpose::packing, Purpose::statics, Purpose::simulation, Purpose::continuum};

/// What a command gives, as numbers; nothing where it refuses the scene.
using Outcome = std::optional<std::vector<double>>;
using Outcomes = std::map<Purpose, Outcome>;

void add(std::vector<double>& all, const std::vector<double>& values) { all.insert(all.end(), values.begin(), values.end()); }

std::vector<double> packing_of(const Scene& scene) {
  const Packing packing = build_packing(scene);
  std::vector<double> all{packing.length, packing.width, packing.period.x, packing.period.y, bonding_of(scene, packing).coordination};
  for (const auto* values : {&packing.x, &packing.y, &packing.radius}) add(all, *values);
  return all;
}

std::vector<double> statics_of(const Scene& scene) {
  const SceneModuli m = scene_moduli(scene);
  std::vector<double> all{m.bulk_density, m.solid_fraction, m.coordination};
  if (m.stiffness) all.insert(all.end(), m.stiffness->data(), m.stiffness->data() + m.stiffness->size());
  if (m.strip) all.push_back(m.strip->bar_velocity());
  return all;
}

std::vector<double> motion_of(const Scene& scene) {
  RunOptions options;
  options.warn = false;
  const DemRun run = run_scene(scene, options);
  std::vector<double> all{run.time_step, run.result.breakdown ? static_cast<double>(run.result.breakdown->step) : -1.0};
  add(all, run.result.signals.time);
  for (const auto* component : {&run.result.signals.ux, &run.result.signals.uy, &run.result.signals.theta})
    for (const std::vector<double>& signal : *component) add(all, signal);
  return all;
}

std::vector<double> continuum_of(const Scene& scene) {
  std::optional<SceneModuli> moduli;
  if (!continuum_stands_alone(scene)) moduli = scene_moduli(scene);
  const FemPlan plan = plan_fem(scene, moduli);
  const FemCase& c = plan.fem;
  std::vector<double> all{c.length, c.width, static_cast<double>(c.elements[0]), static_cast<double>(c.elements[1]), static_cast<double>(c.degree),
                          c.material.young_modulus, c.material.poisson_ratio, c.material.density, static_cast<double>(c.periodic),
                          static_cast<double>(c.left), static_cast<double>(c.right), static_cast<double>(c.integrator), c.end,
                          static_cast<double>(c.sample_every), static_cast<double>(c.load.index()), plan.context.source_duration,
                          plan.context.source_amplitude, plan.context.source_centre, plan.context.pulse_half_width, c.column_spacing};
  if (const auto* drive = std::get_if<Drive>(&c.load)) add(all, {static_cast<double>(drive->wave), drive->amplitude});
  if (const auto* pulse = std::get_if<InitialPulse>(&c.load))
    add(all, {static_cast<double>(pulse->wave), static_cast<double>(pulse->shape), pulse->amplitude});
  all.push_back(std::holds_alternative<StepSeconds>(c.step) ? -std::get<StepSeconds>(c.step).seconds : std::get<StepFraction>(c.step).of_critical);
  for (const char letter : c.mesh) all.push_back(letter);
  for (const auto& [x, y] : c.points) add(all, {x, y});
  add(all, c.sections);
  return all;
}

Outcome outcome_of(const std::string& text, Purpose purpose) {
  const SceneResult scene = parse_scene(text, "scene.toml", folder_of_files(), {purpose});
  if (!scene) return std::nullopt;
  try {
    switch (purpose) {
      case Purpose::packing: return packing_of(*scene);
      case Purpose::statics: return statics_of(*scene);
      case Purpose::simulation: return motion_of(*scene);
      case Purpose::continuum: return continuum_of(*scene);
    }
  } catch (const InputError&) {
  } catch (const SolverError&) {
  }
  return std::nullopt;
}

Outcomes outcomes_of(const SceneKeys& keys) {
  static std::map<std::string, Outcomes> known;
  const std::string text = toml_of(keys);
  const auto [found, fresh] = known.try_emplace(text);
  if (fresh) {
    for (const Purpose purpose : kPurposes) found->second[purpose] = outcome_of(text, purpose);
  }
  return found->second;
}

bool same(const Outcome& a, const Outcome& b) {
  const auto bits = [](double x, double y) { return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y); };
  return a.has_value() == b.has_value() && (!a || std::equal(a->begin(), a->end(), b->begin(), b->end(), bits));
}

enum class Effect { refused, seen, none };

/// Of the values of a key in a scene. Where a command that took the scene refuses it with the key's value, that is said.
Effect effect_of(const SceneKeys& scene, const std::string& key, const std::vector<std::string>& values) {
  const Outcomes before = outcomes_of(scene);
  std::vector<Outcomes> after;
  for (const std::string& value : values) {
    SceneKeys changed = scene;
    changed[key] = value;
    after.push_back(outcomes_of(changed));
  }
  bool refused = false;
  for (const Purpose purpose : kPurposes) {
    for (const Outcomes& outcomes : after) {
      if (outcomes.at(purpose) && after.front().at(purpose) && !same(outcomes.at(purpose), after.front().at(purpose))) return Effect::seen;
      if (before.at(purpose) && !outcomes.at(purpose)) refused = true;
    }
  }
  return refused ? Effect::refused : Effect::none;
}

/// What a name is called, how many threads there are, and what is allowed but not done, changes no result: as promised.
bool changes_no_result(const std::string& key) {
  return key == "title" || key == "run.threads" || key == "time.allow_above_critical";
}

/// The commands in which a key of this table can do something at all.
std::vector<Purpose> commands_of(const KeySpec& spec) {
  static const std::set<std::string_view> of_motion = {"kinematics", "new_contacts", "evaluations", "relaxation", "solver", "tolerance"};
  if (spec.table == "continuum") return {Purpose::continuum};
  if (of_motion.contains(spec.key)) return {Purpose::simulation};
  const bool moves = spec.table == "initial" || spec.table == "drive" || spec.table == "time" || spec.table == "probes";
  return moves ? std::vector{Purpose::simulation, Purpose::continuum} : std::vector(std::begin(kPurposes), std::end(kPurposes));
}

bool any_of(const Outcomes& outcomes, const std::vector<Purpose>& commands) {
  return std::any_of(commands.begin(), commands.end(), [&](Purpose p) { return outcomes.at(p).has_value(); });
}

/// Where displacements are small beside the discs, as linear kinematics asks, nothing meets; assembly.periodic overrides boundary.top_bottom, and
/// scheme = "none" all of [deformation], as their lines in the reference say.
bool does_nothing_by_right(const SceneKeys& scene, const std::string& key) {
  const auto is = [&scene](const char* name, const char* value) { return scene.contains(name) && scene.at(name) == value; };
  if (key == "boundary.top_bottom") return is("assembly.periodic", "\"y\"") || is("assembly.periodic", "\"xy\"");
  if (key.starts_with("deformation.")) return is("deformation.scheme", "\"none\"");
  return key == "contact.new_contacts";
}

/// Keys that can do something in a base.
std::vector<const KeySpec*> keys_of(const BaseScene& base) {
  std::vector<const KeySpec*> keys;
  for (const KeySpec& spec : scene_keys()) {
    const std::string key = dotted_name(spec.table, spec.key);
    const bool only_choice = spec.type == ValueType::choice && split_names(spec.choices).size() == 1;
    if (changes_no_result(key) || only_choice || does_nothing_by_right(base.keys, key)) continue;
    if (any_of(outcomes_of(base.keys), commands_of(spec))) keys.push_back(&spec);
  }
  return keys;
}

TEST(EveryKey, DoesSomethingAloneOrIsRefused) {
  for (const BaseScene& base : base_scenes()) {
    const Outcomes outcomes = outcomes_of(base.keys);
    EXPECT_TRUE(any_of(outcomes, {std::begin(kPurposes), std::end(kPurposes)})) << base.name;
    for (const KeySpec* spec : keys_of(base)) {
      const std::string key = dotted_name(spec->table, spec->key);
      EXPECT_EQ(effect_of(base.keys, key, values_of(*spec)) == Effect::none, false) << base.name << ": " << key;
    }
  }
}

/// Of a pair one in so many, the same ones on every run; DDEM_ALL_PAIRS=1 tries them all, which takes minutes.
bool is_tried(std::size_t pair) {
  constexpr std::size_t one_in = 64;
  return std::getenv("DDEM_ALL_PAIRS") != nullptr || (pair * 2654435761u >> 7) % one_in == 0;
}

TEST(EveryKey, DoesSomethingBesideEachOtherOrIsRefused) {
  std::size_t pair = 0;
  for (const BaseScene& base : base_scenes()) {
    const Outcomes alone = outcomes_of(base.keys);
    for (const KeySpec& other : scene_keys()) {
      const std::string other_key = dotted_name(other.table, other.key);
      for (const std::string& value : values_of(other)) {
        for (const KeySpec* spec : keys_of(base)) {
          const std::string key = dotted_name(spec->table, spec->key);
          if (key == other_key || !is_tried(pair++)) continue;
          SceneKeys scene = base.keys;
          scene[other_key] = value;
          if (does_nothing_by_right(scene, key)) continue;
          const Outcomes beside = outcomes_of(scene);
          const auto commands = commands_of(*spec);
          const bool refused = std::any_of(commands.begin(), commands.end(), [&](Purpose p) { return alone.at(p) && !beside.at(p); });
          if (refused) continue;
          EXPECT_EQ(effect_of(scene, key, values_of(*spec)) == Effect::none, false) << base.name << ": " << key << " beside " << other_key << " = " << value;
        }
      }
    }
  }
}

}  // namespace
}  // namespace ddem::harness::test
