#include "harness/cli/measure_scene.h"

#include <fmt/format.h>

#include "harness/cli/print_json.h"
#include "harness/cli/run_summary.h"
#include "harness/cli/scene_argument.h"
#include "harness/io/errors.h"
#include "harness/io/message.h"
#include "harness/measure/elastic_constants.h"
#include "harness/run/measure_signals.h"
#include "harness/run/run_json.h"
#include "harness/scene/units.h"

namespace ddem::harness {
namespace {

enum class Kind { bar, shear, p };

/// One scene with what was measured of it.
struct Measured {
  MeasuredSignals signals;
  Kind kind;
  std::optional<Uncertain> speed;  ///< by peak
};

Measured measure(const std::string& scene_file, const std::string& signals_file) {
  const Scene scene = load_scene(scene_file, Purpose::simulation);
  Measured m{measure_signals(scene, read_signals_csv(signals_file), signals_file), Kind::shear, {}};
  const DemRun& run = m.signals.run;
  if (run.wave == Wave::longitudinal) m.kind = run.assembly.packing.period.y > 0.0 ? Kind::p : Kind::bar;
  const auto& speed = run.measurement->speed.speed;
  if (speed.ok()) m.speed = Uncertain{speed.value().mean, speed.value().stddev.value_or(0.0)};
  for (const std::string& warning : run.warnings) message("ddem: warning: {}: {}", scene_file, warning);
  return m;
}

struct Modulus {
  const char* name;
  const char* key;
  std::optional<double> by_statics;
};

Modulus modulus_of(const Measured& m) {
  const double density = m.signals.moduli.moving_density;
  const auto& c = m.signals.static_speed;
  const std::optional<double> exact = c ? std::optional(density * *c * *c) : std::nullopt;  // along x: of the very strip or packing
  switch (m.kind) {
    case Kind::bar: return {"E", "young_modulus", exact};
    case Kind::shear: return {"G", "shear_modulus", exact};
    case Kind::p: return {"K + G", "p_modulus", exact};
  }
  return {};
}

Json phase_json(const Measured& m) {
  Json list = Json::array();
  const ProbeLayout& layout = m.signals.run.layout;
  for (std::size_t k = 0; k < m.signals.phase_velocities.size(); ++k) {
    const auto& found = m.signals.phase_velocities[k];
    const ProbePair& pair = layout.pairs[k];
    Json j{{"from", layout.probes[pair.from].name}, {"to", layout.probes[pair.to].name}, {"status", found.ok() ? "ok" : found.error().reason}};
    j["frequency"] = found.ok() ? Json(found.value().frequency) : Json::array();
    j["speed"] = found.ok() ? Json(found.value().speed) : Json::array();
    list.push_back(std::move(j));
  }
  return list;
}

Json json_of(const Measured& m) {
  const DemRun& run = m.signals.run;
  Json j{{"status", "ok"}, {"warnings", run.warnings}, {"samples", run.result.signals.time.size()}, {"sample_interval", run.sample_interval}};
  add_measurement(j, run.measurement, run.layout, "");
  j["picks"] = picks_json(*run.measurement, run.layout);
  j["phase_velocity"] = phase_json(m);
  const Modulus modulus = modulus_of(m);
  const std::string none = "the scene has no static speed of this wave";
  j["static_speed"] = m.signals.static_speed ? Json(*m.signals.static_speed) : Json{{"status", none}};
  j["moving_density"] = m.signals.moduli.moving_density;
  j[modulus.key] = m.speed ? Json(young_modulus_from_bar(m.signals.moduli.moving_density, *m.speed).value) : Json{{"status", "no wave speed"}};
  j["static_" + std::string(modulus.key)] = modulus.by_statics ? Json(*modulus.by_statics) : Json{{"status", none}};
  return j;
}

void print(const Measured& m) {
  const DemRun& run = m.signals.run;
  fmt::print("{} samples of {}\n", run.result.signals.time.size(), format_quantity(run.sample_interval, "s"));
  print_speeds(*run.measurement, run.layout);
  if (!m.speed) return;
  const Modulus modulus = modulus_of(m);
  const auto beside = [](double measured, double expected) { return fmt::format("{:+.3f} %", 100.0 * (measured / expected - 1.0)); };
  if (const auto& c = m.signals.static_speed) fmt::print("static speed {:.5g} m/s: measured {}\n", *c, beside(m.speed->value, *c));
  const Uncertain value = young_modulus_from_bar(m.signals.moduli.moving_density, *m.speed);  // rho c^2, whichever wave
  fmt::print("{} = {}, standard deviation {}", modulus.name, format_quantity(value.value, "Pa"), format_quantity(value.stddev, "Pa", 2));
  if (modulus.by_statics) fmt::print("; static {}", format_quantity(*modulus.by_statics, "Pa"));
  fmt::print("\n");
}

/// Of the two waves, or why there is none.
Outcome<Uncertain> poisson_ratio(const Measured& a, const Measured& b) {
  const Measured& shear = a.kind == Kind::shear ? a : b;
  const Measured& other = a.kind == Kind::shear ? b : a;
  if (shear.kind != Kind::shear || other.kind == Kind::shear)
    return FailedMeasurement{Failure::inconsistent, "Poisson's ratio needs one shear wave, and one bar or P wave"};
  if (!shear.speed || !other.speed) return FailedMeasurement{Failure::too_few_picks, "one of the waves has no speed"};
  return other.kind == Kind::bar ? poisson_ratio_from_bar_and_shear(*other.speed, *shear.speed) : poisson_ratio_from_p_and_shear(*other.speed, *shear.speed);
}

}  // namespace

int measure_scenes(const std::vector<std::string>& words, bool json) {
  if (words.size() != 2 && words.size() != 4)
    throw InputError("ddem measure: give a scene and its signals, or two scenes (a bar and a shear wave) with theirs: SCENE SIGNALS SCENE SIGNALS");
  std::vector<Measured> measured;
  for (std::size_t k = 0; k < words.size(); k += 2) measured.push_back(measure(words[k], words[k + 1]));
  std::optional<Outcome<Uncertain>> nu;
  if (measured.size() == 2) nu = poisson_ratio(measured[0], measured[1]);
  if (json) {
    Json j = json_of(measured[0]);
    if (nu) {
      j = {{"status", "ok"}, {"measurements", {std::move(j), json_of(measured[1])}}};
      j["poisson_ratio"] = nu->ok() ? Json(nu->value().value) : Json{{"status", nu->error().reason}};
      if (nu->ok()) j["poisson_ratio_stddev"] = nu->value().stddev;
    }
    print_json(j);
  } else {
    for (const Measured& m : measured) print(m);
    if (nu && nu->ok()) fmt::print("nu = {:.4f}, standard deviation {:.2g}\n", nu->value().value, nu->value().stddev);
    if (nu && !nu->ok()) fmt::print("no Poisson's ratio: {}\n", nu->error().reason);
  }
  return static_cast<int>(ExitCode::done);
}

}  // namespace ddem::harness
