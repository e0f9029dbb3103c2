// Numbers at the ends of what they may be: every command gives finite numbers, or refuses with a reason.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "harness/io/errors.h"
#include "harness/run/dem_run.h"
#include "harness/run/fem_plan.h"
#include "harness/run/scene_moduli.h"
#include "harness/run/scene_stability.h"
#include "harness/scene/read_scene.h"
#include "tests/harness/run/key_values.h"

namespace ddem::harness::test {
namespace {

using Numbers = std::vector<double>;

void add(Numbers& all, const Numbers& values) { all.insert(all.end(), values.begin(), values.end()); }

Numbers numbers_of_run(const Scene& scene) {
  const DemRun run = run_scene(scene);
  Numbers all{run.critical_time_step, run.time_step, run.sample_interval, run.result.energy_drift.value_or(0.0)};
  if (run.result.breakdown) return all;
  add(all, run.result.signals.time);
  for (const auto* component : {&run.result.signals.ux, &run.result.signals.uy, &run.result.signals.theta})
    for (const Numbers& signal : *component) add(all, signal);
  for (const EnergySample& e : run.result.energy) add(all, {e.time, e.energies.kinetic, e.energies.contact, e.energies.particle});
  return all;
}

Numbers numbers_of_statics(const Scene& scene) {
  const SceneModuli m = scene_moduli(scene);
  Numbers all{m.bulk_density, m.solid_fraction, m.coordination};
  if (m.stiffness) all.insert(all.end(), m.stiffness->data(), m.stiffness->data() + m.stiffness->size());
  if (m.strip) all.push_back(m.strip->bar_velocity());
  return all;
}

Numbers numbers_of_stability(const Scene& scene) {
  const SceneStability s = scene_stability(scene, {});
  Numbers all{s.dem_critical_step, s.time_step, s.softness, s.critical.step.value_or(0.0), s.fixed_point_radius.value_or(0.0)};
  for (const WaveGrowth& w : s.waves) add(all, {w.frequency, w.growth, w.phase_speed()});
  return all;
}

Numbers numbers_of_continuum(const Scene& scene) {
  std::optional<SceneModuli> moduli;
  if (!continuum_stands_alone(scene)) moduli = scene_moduli(scene);
  const FemCase c = plan_fem(scene, moduli).fem;
  return {c.length, c.width, c.material.young_modulus, c.material.poisson_ratio, c.material.density, c.column_spacing, c.end};
}

/// Values at and near both ends of what the key may be, and the usual one.
std::string extreme_value(const KeySpec& spec, const std::string& usual, std::mt19937& random) {
  const Magnitude m = magnitude_of(spec.dimension);
  const double low = std::max(m.least, std::isfinite(spec.range.low) ? spec.range.low : m.least);
  const double high = std::min(m.most, spec.range.high);
  switch (random() % 6) {
    case 0: return fmt::format("{}", low);
    case 1: return fmt::format("{}", high * (spec.range.high_excluded ? 1.0 - 1e-9 : 1.0));
    case 2: return fmt::format("{}", low * std::pow(high / low, static_cast<double>(random() % 1000) / 1000.0));
    default: return usual;
  }
}

struct Command {
  const char* name;
  Purpose purpose;
  std::function<Numbers(const Scene&)> numbers;
};
const Command kCommands[] = {{"run", Purpose::simulation, numbers_of_run},
                             {"moduli", Purpose::statics, numbers_of_statics},
                             {"stability", Purpose::statics, numbers_of_stability},
                             {"fem", Purpose::continuum, numbers_of_continuum}};

/// "" where all is well.
std::string problem_of(const Command& command, const std::string& text) {
  const SceneResult scene = parse_scene(text, "scene.toml", folder_of_files(), {command.purpose});
  if (!scene) return "";
  try {
    for (const double x : command.numbers(*scene)) {
      if (!std::isfinite(x)) return fmt::format("gives {}", x);
    }
  } catch (const InputError&) {
  } catch (const SolverError&) {
  } catch (const std::exception& e) {
    return fmt::format("throws {}", e.what());
  }
  return "";
}

TEST(Extremes, GiveFiniteNumbersOrAReason) {
  std::mt19937 random(3);
  for (int round = 0; round < 40; ++round) {
    for (const BaseScene& base : base_scenes()) {
      SceneKeys keys = base.keys;
      for (const char* extra : {"assembly.thickness", "time.step_fraction"}) {
        if (random() % 2 == 0) keys.try_emplace(extra, "0.5");
      }
      for (auto& [key, value] : keys) {
        const KeySpec& spec = scene_keys()[find_key(key).value()];
        if (spec.type == ValueType::number) value = extreme_value(spec, value, random);
      }
      const std::string text = toml_of(keys);
      for (const Command& command : kCommands) EXPECT_EQ(problem_of(command, text), "") << command.name << " of\n" << text;
    }
  }
}

}  // namespace
}  // namespace ddem::harness::test
