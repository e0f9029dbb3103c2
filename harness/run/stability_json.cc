#include <fmt/format.h>

#include "harness/run/run_json.h"

namespace ddem::harness {
namespace {

const char* name(Scheme scheme) {
  switch (scheme) {
    case Scheme::none: return "none";
    case Scheme::lagged: return "lagged";
    case Scheme::implicit: return "implicit";
  }
  return "";
}

const char* name(Correction correction) {
  switch (correction) {
    case Correction::normal: return "normal";
    case Correction::full: return "full";
    case Correction::normal_only_stress: return "normal_only_stress";
  }
  return "";
}

const char* name(StabilityVerdict verdict) {
  switch (verdict) {
    case StabilityVerdict::stable: return "stable";
    case StabilityVerdict::unstable: return "unstable";
    case StabilityVerdict::undecided: return "undecided";
  }
  return "";
}

const char* name(StepBound bound) {
  switch (bound) {
    case StepBound::oscillation: return "oscillation";
    case StepBound::flip: return "flip";
    case StepBound::fixed_point: return "fixed_point";
    case StepBound::feeding: return "feeding";
  }
  return "";
}

Json status(const std::string& why) { return Json{{"status", why}}; }

Json optional_number(const std::optional<double>& value, const std::string& why_not) {
  return value ? number_or_status(*value, why_not) : status(why_not);
}

void add_softness(Json& j, const SceneStability& s) {
  const bool active = s.deformation.active(), lagged = s.deformation.scheme == Scheme::lagged;
  const std::string rigid = "plain DEM has no particle strains";
  const std::string free = active ? "implicit strains set no limit" : rigid;
  j["fixed_point_radius"] = optional_number(s.fixed_point_radius, rigid);
  j["fixed_point_radius_limit"] = lagged ? Json(s.radius_limit) : status(free);
  j["softness"] = active ? Json(s.softness) : status(rigid);
  j["largest_stable_softness"] = optional_number(s.softness_limit, free);
  const auto& limit = s.softness_limit_at_step;
  const std::string none = lagged ? "this step is stable at no softness" : free;
  j["largest_stable_softness_at_step"] = limit ? Json(limit->at_least) : status(none);
  j["largest_stable_softness_at_step_at_most"] = limit ? Json(limit->at_most) : status(none);
}

void add_verdict(Json& j, const SceneStability& s) {
  const StabilityVerdict verdict = s.verdict();
  const bool undecided = verdict == StabilityVerdict::undecided;
  j["stability"] = name(verdict);
  j["stable_at_step_fraction"] = undecided ? Json() : Json(verdict == StabilityVerdict::stable);
  j["instabilities"] = s.instabilities();
  j["growth_per_step"] = optional_number(s.step_growth, s.critical_step_decides() ? "the critical step decides" : "too many discs for the step's eigenvalues");
  j["steps_needed"] = undecided ? Json(s.steps_needed()) : status("the verdict needs no run");
  j["slowest_growth_per_step"] = undecided ? Json(s.slowest_growth) : status("the verdict needs no run");
}

void add_growth_without_energy(Json& j, const SceneStability& s) {
  const std::string energy = "none: the scheme derives from an energy";
  j["flutter"] = status(s.has_energy() ? energy : "the hexagonal lattice has none");
  if (s.noise_flutter) {
    const NoiseFlutter& f = *s.noise_flutter;
    j["flutter"] = {{"method", "noise_run"}, {"detectable", f.detectable}, {"status", f.found ? "ok" : "none found"}};
    if (f.found) {
      j["flutter"]["growth_rate"] = f.growth_rate;
      j["flutter"]["growth_rate_over_largest_frequency"] = f.growth_rate / f.largest_frequency;
    }
  }
  if (s.flutter) {
    j["flutter"] = {{"method", "arnoldi"}, {"detectable", s.flutter->detectable}};
    if (s.flutter->frequency) {
      j["flutter"]["status"] = "ok";
      j["flutter"]["frequency"] = s.flutter->frequency->real();
      j["flutter"]["growth_rate"] = s.flutter->frequency->imag();
      j["flutter"]["growth_rate_over_largest_frequency"] = s.flutter->frequency->imag() / s.flutter->largest_frequency;
    } else {
      j["flutter"]["status"] = "none found";
    }
  }
  j["noise_run"] = status(s.has_energy() ? energy : "not run: the step's eigenvalues decide");
  if (s.noise) {
    j["noise_run"] = {{"status", s.noise->diverged ? "diverged" : "ok"},
                      {"steps", s.noise->steps},
                      {"growth_per_step", s.noise->growth},
                      {"detectable_per_step", s.noise->detectable},
                      {"resolution", s.noise->resolution}};
  }
}

}  // namespace

Json stability_json(const SceneStability& s) {
  const std::string no_step = s.critical.bound == StepBound::feeding ? "no step is safe for sure: an even number of evaluations overshoots in some strains"
                                                                     : "no step is stable";
  Json j{{"status", "ok"},
         {"discs", s.discs},
         {"bonds", s.bonds},
         {"scheme", name(s.deformation.scheme)},
         {"correction", s.deformation.active() ? Json(name(s.deformation.correction)) : status("plain DEM has none")},
         {"time_step", s.time_step},
         {"step_fraction", s.time_step / s.dem_critical_step},
         {"critical_time_step", optional_number(s.critical.step, no_step)},
         {"critical_time_step_bound", name(s.critical.bound)},
         {"dem_critical_time_step", s.dem_critical_step}};
  j["largest_stable_step_fraction"] =
      s.critical.step ? Json(*s.critical.step / s.dem_critical_step) : status(no_step);
  add_verdict(j, s);
  add_softness(j, s);
  add_growth_without_energy(j, s);
  if (s.lattice) {
    j["infinite_lattice"] = {{"largest_growth_per_step", s.lattice->worst.growth},
                             {"wave_vector", {s.lattice->worst.wave.x, s.lattice->worst.wave.y}},
                             {"largest_stable_step", optional_number(s.lattice->largest_stable_step, "every step grows")}};
  } else {
    j["infinite_lattice"] = status("the packing is not hexagonal");
  }
  j["waves"] = Json::array();
  for (const WaveGrowth& w : s.waves) {
    j["waves"].push_back({{"wave", w.wave},
                          {"wavelength", w.wavelength},
                          {"frequency", w.frequency},
                          {"phase_speed", w.phase_speed()},
                          {"growth_per_step", w.growth},
                          {"growth_per_period", w.growth_per_period(s.time_step)},
                          {"method", w.exact ? "bloch" : "static_moduli"}});
  }
  if (!s.no_waves.empty()) j["waves_status"] = s.no_waves;
  return j;
}

}  // namespace ddem::harness
