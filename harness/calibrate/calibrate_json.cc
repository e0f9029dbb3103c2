#include "harness/calibrate/calibrate_json.h"

#include <fmt/format.h>

#include <cmath>

namespace ddem::harness {
namespace {

bool by_modulus(const Scene& scene) {
  return scene.contact && std::holds_alternative<ContactModulus>(scene.contact->stiffness);
}

const char* stiffness_key(const Scene& scene) {
  return by_modulus(scene) ? "contact_modulus" : "normal_stiffness";
}

const char* parameter_key(Parameter p) {
  switch (p) {
    case Parameter::stiffness_ratio:
      return "stiffness_ratio";
    case Parameter::log_softness:
      return "softness";
    case Parameter::particle_poisson_ratio:
      break;
  }
  return "particle_poisson_ratio";
}

Json over_seeds(const MeanWithConfidence& m) {
  Json j{{"mean", m.mean}, {"count", m.count}};
  if (m.count < 2) {
    j["status"] = "one packing has no scatter";
    return j;
  }
  j["stddev"] = m.stddev;
  j["confidence_95"] = {m.mean - m.half_width, m.mean + m.half_width};
  return j;
}

Json or_status(const std::optional<MeanWithConfidence>& m, const std::string& why_not) {
  return m ? over_seeds(*m) : Json{{"status", why_not}};
}

Json target_json(const Target& t) {
  Json j{{"young_modulus", t.young_modulus},
         {"poisson_ratio", t.poisson_ratio},
         {"solid_young_modulus", t.solid_young_modulus},
         {"solid_poisson_ratio", t.solid_poisson_ratio},
         {"conversion", t.conversion}};
  j["young_modulus_uncertainty"] = t.young_modulus * std::sqrt(t.covariance(0, 0));
  j["poisson_ratio_uncertainty"] = std::sqrt(t.covariance(1, 1));
  if (t.density) j["density"] = *t.density;
  return j;
}

Json parameters_json(const Scene& scene, const FoundParameters& f) {
  Json j{{stiffness_key(scene), f.stiffness}, {"stiffness_ratio", f.point.stiffness_ratio}};
  if (scene.deformation) {
    j["softness"] = f.point.softness;
    j["particle_young_modulus"] = f.particle_young_modulus;
    j["particle_poisson_ratio"] = f.point.particle_poisson_ratio;
  }
  if (f.particle_density) j["particle_density"] = *f.particle_density;
  return j;
}

Json uncertainty_json(const Scene& scene, const FoundParameters& f) {
  if (!f.solved_for) return {{"status", "no free parameter answers to nu"}};
  return {{stiffness_key(scene), f.stiffness_stddev},
          {parameter_key(*f.solved_for), f.solved_stddev},
          {"meaning", "standard deviations from the target's own, other parameters held"}};
}

Json ranges_json(const Calibration& c) {
  Json list = Json::array();
  for (const VariantRange& v : c.ranges) {
    list.push_back(
        {{"variant", v.name}, {"lowest", v.poisson.lowest}, {"highest", v.poisson.highest}, {"own", v.own}});
  }
  return list;
}

Json wave_json(const std::optional<ProofWave>& w, const std::string& why_not) {
  if (!w) return {{"status", why_not}};
  Json j{{"status", w->failure.empty() ? "ok" : w->failure}, {"static_speed", w->static_speed}};
  if (w->section_speed > 0.0) j["static_speed_between_sections"] = w->section_speed;
  if (w->peak) j["wave_speed"] = *w->peak;
  if (w->centroid) j["wave_speed_by_centroid"] = *w->centroid;
  return j;
}

std::vector<double> of_seeds(const Proof& p, double ProofSeed::*member) {
  std::vector<double> values;
  for (const ProofSeed& s : p.seeds) values.push_back(s.*member);
  return values;
}

Json proof_json(const Calibration& c, const Proof& p) {
  const MeanWithConfidence young = mean_with_confidence(of_seeds(p, &ProofSeed::young_modulus));
  const MeanWithConfidence poisson = mean_with_confidence(of_seeds(p, &ProofSeed::poisson_ratio));
  Json j{{"packings", p.unseen ? "seeds that were not fitted" : "the fitted packing: it has no seeds"}};
  j["young_modulus"] = over_seeds(young);
  j["young_modulus_residual"] = young.mean / c.target.young_modulus - 1.0;
  j["poisson_ratio"] = over_seeds(poisson);
  j["poisson_ratio_residual"] = poisson.mean - c.target.poisson_ratio;
  const std::string none = p.no_waves.empty() ? "no seed gave a speed" : p.no_waves;
  j["shear_over_static"] = or_status(dynamic_deviation(p, &ProofSeed::shear, &ProofWave::peak), none);
  j["shear_over_static_by_centroid"] =
      or_status(dynamic_deviation(p, &ProofSeed::shear, &ProofWave::centroid), none);
  j["p_over_static"] = or_status(dynamic_deviation(p, &ProofSeed::p, &ProofWave::peak), none);
  j["p_over_static_by_centroid"] = or_status(dynamic_deviation(p, &ProofSeed::p, &ProofWave::centroid), none);
  j["finite_width_bar_bias"] = or_status(bar_bias(p), none);
  j["seeds"] = Json::array();
  for (const ProofSeed& s : p.seeds) {
    Json one{{"seed", s.seed},
             {"young_modulus", s.young_modulus},
             {"poisson_ratio", s.poisson_ratio},
             {"bulk_bar_velocity", s.bulk_bar}};
    if (!p.unseen) one.erase("seed");
    if (s.strip_bar) one["strip_bar_velocity"] = *s.strip_bar;
    one["shear"] = wave_json(s.shear, none);
    one["p"] = wave_json(s.p, none);
    j["seeds"].push_back(one);
  }
  j["seconds"] = p.seconds;
  return j;
}

std::string with_interval(const MeanWithConfidence& m, const char* format, double scale = 1.0) {
  std::string text = fmt::format(fmt::runtime(format), scale * m.mean);
  if (m.count > 1) text += fmt::format(" +- {:.2g}", scale * m.half_width);
  return text;
}

std::string parameters_text(const Scene& scene, const FoundParameters& f) {
  const auto sigma = [&](Parameter p) {
    return f.solved_for == p && f.solved_stddev > 0.0 ? fmt::format(" +- {:.2g}", f.solved_stddev)
                                                      : std::string();
  };
  const char* const unit = by_modulus(scene) ? "Pa" : "N/m";
  std::string t =
      fmt::format("  {} = {}{}\n  k_t/k_n = {:.9g}{}\n", by_modulus(scene) ? "contact modulus" : "k_n",
                  format_quantity(f.stiffness, unit, 9),
                  f.stiffness_stddev > 0.0 ? " +- " + format_quantity(f.stiffness_stddev, unit, 2) : "",
                  f.point.stiffness_ratio, sigma(Parameter::stiffness_ratio));
  if (scene.deformation) {
    t += fmt::format("  k_n/E_p = {:.6g}{}, E_p = {}\n  nu_p = {:.6g}{}\n", f.point.softness,
                     sigma(Parameter::log_softness), format_quantity(f.particle_young_modulus, "Pa", 9), f.point.particle_poisson_ratio,
                     sigma(Parameter::particle_poisson_ratio));
  }
  if (f.particle_density) t += fmt::format("  density of a disc = {:.6g} kg/m3\n", *f.particle_density);
  return t;
}

std::string ranges_text(const Calibration& c) {
  std::string t = "Poisson's ratios within reach on this assembly, k_t/k_n from 0 to 1:\n";
  for (const VariantRange& v : c.ranges) {
    t += fmt::format("  {:<12} {:7.4f} to {:.4f}{}\n", v.name, v.poisson.lowest, v.poisson.highest,
                     v.own ? "   (this scene, what is free)" : "");
  }
  return t;
}

std::string deviation_line(const char* what, const std::optional<MeanWithConfidence>& m) {
  return m ? fmt::format("  {:<44} {} %\n", what, with_interval(*m, "{:+.3f}", 100.0)) : "";
}

std::string proof_text(const Calibration& c, const Proof& p) {
  const auto young = mean_with_confidence(of_seeds(p, &ProofSeed::young_modulus)),
             poisson = mean_with_confidence(of_seeds(p, &ProofSeed::poisson_ratio));
  std::string t = fmt::format("Proof on {} (mean +- 95 % confidence):\n",
                              p.unseen ? fmt::format("seeds {} to {}, which were not fitted",
                                                     p.seeds.front().seed, p.seeds.back().seed)
                                       : "the fitted packing, which has no seeds");
  t += fmt::format("  static E = {}{} ({:+.3f} %), nu = {} ({:+.5f})\n", format_quantity(young.mean, "Pa"),
                   young.count > 1 ? " +- " + format_quantity(young.half_width, "Pa", 2) : "",
                   100.0 * (young.mean / c.target.young_modulus - 1.0), with_interval(poisson, "{:.5f}"),
                   poisson.mean - c.target.poisson_ratio);
  if (!p.no_waves.empty()) return t + "  no waves: " + p.no_waves + "\n";
  t += deviation_line("shear pulse over its own static speed",
                      dynamic_deviation(p, &ProofSeed::shear, &ProofWave::peak));
  t += deviation_line("P pulse over its own static speed",
                      dynamic_deviation(p, &ProofSeed::p, &ProofWave::peak));
  t += deviation_line("the same by centroid: shear",
                      dynamic_deviation(p, &ProofSeed::shear, &ProofWave::centroid));
  t += deviation_line("the same by centroid: P", dynamic_deviation(p, &ProofSeed::p, &ProofWave::centroid));
  t += deviation_line("bar of the free strip over the bulk's (width)", bar_bias(p));
  for (const ProofSeed& s : p.seeds) {
    for (const auto* w : {&s.shear, &s.p}) {
      if (*w && !(*w)->failure.empty())
        t +=
            fmt::format("  seed {}: no {} speed: {}\n", s.seed, w == &s.shear ? "shear" : "P", (*w)->failure);
    }
  }
  return t;
}

}  // namespace

Json calibration_json(const Scene& scene, const Calibration& c, const std::optional<Proof>& proof) {
  Json j{{"feasible", c.feasible}};
  j["target"] = target_json(c.target);
  j["parameters"] = parameters_json(scene, c.found);
  if (!c.feasible) j["parameters"]["status"] = "of the nearest reachable target";
  j["choice"] = c.choice;
  j["young_modulus"] = c.young_modulus;
  j["poisson_ratio"] = c.poisson_ratio;
  j["residuals"] = {{"young_modulus", c.young_residual()}, {"poisson_ratio", c.poisson_residual()}};
  if (!c.feasible) {
    j["nearest"] = {{"young_modulus", c.young_modulus}, {"poisson_ratio", c.poisson_ratio}};
    j["what_helps"] = c.what_helps;
  } else {
    j["uncertainty"] = uncertainty_json(scene, c.found);
  }
  j["seeds"] = c.seeds;
  j["over_seeds"] = {{"young_modulus", over_seeds(c.young_over_seeds)},
                     {"poisson_ratio", over_seeds(c.poisson_over_seeds)}};
  j["solid_fraction"] = c.solid_fraction;
  j["reachable"] = ranges_json(c);
  if (c.stability) {
    j["stability"] = {{"fixed_point_radius", c.stability->radius}};
    j["stability"]["limit"] = c.stability->limit ? Json(*c.stability->limit)
                                                 : Json("none: implicit strains are stable at any softness");
    if (!c.stability->remark.empty()) j["stability"]["remark"] = c.stability->remark;
  }
  j["notes"] = c.notes;
  j["seconds"] = c.seconds;
  if (proof) j["proof"] = proof_json(c, *proof);
  return j;
}

std::string calibration_text(const Scene& scene, const Calibration& c, const std::optional<Proof>& proof) {
  std::string t = fmt::format("Target: E = {}, nu = {:.8g} in the plane ({})\n",
                              format_quantity(c.target.young_modulus, "Pa", 8), c.target.poisson_ratio, c.target.conversion);
  t += ranges_text(c);
  if (!c.feasible) {
    t += fmt::format("INFEASIBLE: nu = {:.6g} is out of reach. Nearest: nu = {:.6g}, with\n",
                     c.target.poisson_ratio, c.poisson_ratio);
  } else {
    t += fmt::format("Found ({}):\n", c.choice);
  }
  t += parameters_text(scene, c.found);
  for (const std::string& help : c.what_helps) t += fmt::format("  what would help: {}\n", help);
  t += fmt::format("They give E = {} ({:+.2g}), nu = {:.9g} ({:+.2g})", format_quantity(c.young_modulus, "Pa", 9),
                   c.young_residual(), c.poisson_ratio, c.poisson_residual());
  if (c.seeds.size() > 1) {
    t += fmt::format(", means over seeds {} to {}; one packing scatters by {:.2g} % and {:.2g}",
                     c.seeds.front(), c.seeds.back(), 100.0 * c.young_over_seeds.stddev / c.young_modulus,
                     c.poisson_over_seeds.stddev);
  }
  t += "\n";
  if (c.stability) {
    t += fmt::format("Spectral radius of K B: {:.4g}{}\n", c.stability->radius,
                     c.stability->limit ? fmt::format(", which must stay below {:.4g}", *c.stability->limit)
                                        : "; implicit strains are stable at any");
    if (!c.stability->remark.empty()) t += "Beware: " + c.stability->remark + "\n";
  }
  for (const std::string& note : c.notes) t += "Note: " + note + "\n";
  if (proof) t += proof_text(c, *proof);
  return t;
}

}  // namespace ddem::harness
