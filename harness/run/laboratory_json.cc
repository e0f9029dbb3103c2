#include "harness/run/laboratory_json.h"

#include <algorithm>

namespace ddem::harness {
namespace {

/// {"time": 1, "stddev": 0.1, "status": "ok"}, or nulls and why.
Json value_json(const char* name, const Outcome<Uncertain>& value) {
  Json j;
  j[name] = value.ok() ? Json(value.value().value) : Json();
  j["stddev"] = value.ok() ? Json(value.value().stddev) : Json();
  j["status"] = value.ok() ? "ok" : value.error().reason;
  return j;
}

Json sensor_json(const LaboratorySensor& sensor, const SensorReading& r) {
  Json j{{"name", sensor.name}, {"position", sensor.position}};
  const bool seen = r.width > 0.0;
  const auto add = [&](const char* key, const Json& value) { j[key] = seen ? value : Json(); };
  add("polarity", r.negative ? "negative" : "positive");
  add("reversed", r.reversed);
  add("clipped", r.clipped);
  add("height", r.height);
  add("width", r.width);
  add("noise", r.noise);
  add("quiet_until", r.quiet_end);
  add("offset", r.offset);
  add("trend", r.trend);
  j["peak"] = value_json("time", r.peak);
  j["first_break"] = value_json("time", r.first_break);
  j["centroid"] = value_json("time", r.centroid);
  return j;
}

Json phase_json(const Outcome<PhaseVelocity>& v) {
  Json j{{"frequency", Json::array()}, {"speed", Json::array()}, {"status", "ok"}};
  if (v.ok()) {
    j["frequency"] = v.value().frequency;
    j["speed"] = v.value().speed;
  } else {
    j["status"] = v.error().reason;
  }
  return j;
}

Json mean_json(const Outcome<MeanSpeed>& mean) {
  if (!mean.ok()) return {{"speed", nullptr}, {"stddev", nullptr}, {"scatter", nullptr}, {"pairs", 0}, {"status", mean.error().reason}};
  const MeanSpeed& m = mean.value();
  return {
      {"speed", m.mean}, {"stddev", m.stddev}, {"scatter", m.scatter ? Json(*m.scatter) : Json()}, {"pairs", m.pairs}, {"status", "ok"}};
}

}  // namespace

std::string key_of(Mark mark) {
  std::string key(name(mark));
  std::replace(key.begin(), key.end(), ' ', '_');
  return key;
}

Json laboratory_json(const LaboratoryRecording& recording, const LaboratoryOptions& options, const LaboratoryResult& result) {
  const bool any = std::any_of(result.speed.begin(), result.speed.end(), [](const auto& speed) { return speed.ok(); });
  Json j{{"status", any ? "ok" : result.speed.front().error().reason}, {"samples", recording.sensors.front().values.size()}, {"time_step", recording.dt}};
  j["notes"] = result.notes;
  j["sensors"] = Json::array();
  for (std::size_t s = 0; s < result.sensors.size(); ++s) j["sensors"].push_back(sensor_json(recording.sensors[s], result.sensors[s]));
  j["pairs"] = Json::array();
  for (const PairReading& p : result.pairs) {
    Json pair{{"from", recording.sensors[p.from].name}, {"to", recording.sensors[p.to].name}, {"distance", p.distance}};
    for (std::size_t m = 0; m < kMarks.size(); ++m) {
      Json one{{"delay", p.delay[m].ok() ? Json(p.delay[m].value().value) : Json()}};
      one.update(value_json("speed", p.speed[m]));
      pair[key_of(kMarks[m])] = one;
    }
    pair["phase_velocity"] = phase_json(p.phase_velocity);
    j["pairs"].push_back(pair);
  }
  for (std::size_t m = 0; m < kMarks.size(); ++m) {
    const std::string key = key_of(kMarks[m]);
    j["speed"][key] = mean_json(result.speed[m]);
    j["speed_by_" + key] = result.speed[m].ok() ? Json(result.speed[m].value().mean) : Json();
    j["speed_by_" + key + "_status"] = result.speed[m].ok() ? "ok" : result.speed[m].error().reason;
  }
  if (options.wave && !result.modulus.empty()) {
    j["modulus"]["symbol"] = modulus_symbol(*options.wave);
    j["modulus"]["density"] = *options.density;
    for (std::size_t m = 0; m < kMarks.size(); ++m) j["modulus"][key_of(kMarks[m])] = value_json("value", result.modulus[m]);
  }
  return j;
}

}  // namespace ddem::harness
