#include "harness/run/run_json.h"

namespace ddem::harness {
namespace {

/// A number or null, and beside it "ok" or why there is none.
void add_value(Json& j, const std::string& key, const Outcome<double>& value) {
  j[key] = value.ok() ? Json(value.value()) : Json();
  j[key + "_status"] = value.ok() ? "ok" : value.error().reason;
}

Outcome<double> mean_outcome(const WaveSpeed& w) { return w.speed.ok() ? Outcome<double>(w.speed.value().mean) : w.speed.error(); }

Outcome<double> stddev_of(const WaveSpeed& w) {
  if (!w.speed.ok()) return w.speed.error();
  if (const auto& stddev = w.speed.value().stddev) return *stddev;
  return FailedMeasurement{Failure::too_few_picks, "a single pair has no standard deviation"};
}

Json pair_json(const PairSpeed& p, const ProbeLayout& layout) {
  Json pair{{"from", layout.probes[p.from].name}, {"to", layout.probes[p.to].name}, {"distance", p.distance}};
  pair["delay"] = p.speed.ok() ? Json(p.delay.value()) : Json();
  pair["speed"] = p.speed.ok() ? Json(p.speed.value()) : Json();
  pair["status"] = p.speed.ok() ? "ok" : p.speed.error().reason;
  return pair;
}

const char* status_of(Breakdown::Cause cause) {
  switch (cause) {
    case Breakdown::Cause::diverged: return "diverged";
    case Breakdown::Cause::strains_not_converged: return "strains not converged";
    case Breakdown::Cause::strains_indefinite: return "strains indefinite";
    case Breakdown::Cause::contacts_undecided: return "contacts undecided";
  }
  return "failed";
}

}  // namespace

void add_measurement(Json& j, const std::optional<WaveMeasurement>& m, const ProbeLayout& layout, const std::string& why_not) {
  const FailedMeasurement none{Failure::empty_window, why_not}, no_pulse{Failure::no_reference, "a released column sends no pulse of known width"};
  add_value(j, "wave_speed", m ? mean_outcome(m->speed) : none);
  add_value(j, "wave_speed_stddev", m ? stddev_of(m->speed) : none);
  add_value(j, "wave_speed_by_centroid", !m ? none : m->by_centroid ? mean_outcome(*m->by_centroid) : no_pulse);
  add_value(j, "wave_speed_by_correlation", m ? mean_outcome(m->by_correlation) : none);
  j["good_pairs"] = m ? m->speed.good_pairs : 0;
  j["pairs"] = Json::array();
  if (!m) return;
  for (const PairSpeed& p : m->speed.pairs) j["pairs"].push_back(pair_json(p, layout));
}

Json picks_json(const WaveMeasurement& m, const ProbeLayout& layout) {
  Json list = Json::array();
  for (const ProbePick& p : m.picks) {
    Json j{{"probe", layout.probes[p.probe].name}, {"status", p.pick.ok() ? "ok" : p.pick.error().reason}};
    j["time"] = p.pick.ok() ? Json(p.pick.value().time) : Json();
    j["amplitude"] = p.pick.ok() ? Json(p.pick.value().amplitude) : Json();
    j["width"] = p.pick.ok() ? Json(p.pick.value().width) : Json();
    list.push_back(std::move(j));
  }
  return list;
}

Json run_json(const DemRun& run) {
  const SimulationResult& r = run.result;
  Json j{{"status", "ok"}};
  if (r.breakdown) {
    j["status"] = status_of(r.breakdown->cause);
    j["diverged_step"] = r.breakdown->step;
    j["diverged_disc"] = r.breakdown->disc;
  } else if (run.context.obstacle) {  // of a run: its growth
    j["status"] = "unstable";
  }
  j["warnings"] = run.warnings;
  j["discs"] = run.assembly.size();
  j["bonds"] = run.assembly.bonds.size();
  j["rattlers"] = run.assembly.rattlers.size();
  j["bulk_density"] = bulk_density(run.assembly);
  j["moving_density"] = moving_density(run.assembly);
  j["critical_time_step"] = run.critical_time_step;
  j["time_step"] = run.time_step;
  j["steps"] = r.steps_done;
  j["wall_seconds"] = r.wall_seconds;
  if (const auto& c = r.new_contacts) {
    j["new_contacts"] = {{"first_step", c->first_step}, {"most_at_once", c->most}};
    j["new_contacts"]["critical_time_step"] = r.breakdown ? Json{{"status", "the run broke down"}} : Json(c->critical_time_step);
  }
  if (r.steps_done > 0) {
    j["nanoseconds_per_bond_step"] =
        1e9 * r.wall_seconds / (static_cast<double>(run.assembly.bonds.size()) * static_cast<double>(r.steps_done));
  }
  j["energy_drift"] = r.energy_drift ? Json(*r.energy_drift)
                                     : Json{{"status", "not audited: nonlinear kinematics has no leapfrog invariant, or the run "
                                                       "ended before its source did"}};
  add_measurement(j, run.measurement, run.layout, r.breakdown ? "the run broke down" : "the scene has no pairs of probes and pulse");
  return j;
}

Json moduli_json(const SceneModuli& m) {
  Json j{{"status", "ok"},
         {"method", m.method},
         {"discs", m.discs},
         {"bonds", m.bonds},
         {"rattlers", m.rattlers},
         {"coordination", m.coordination},
         {"solid_fraction", m.solid_fraction},
         {"bulk_density", m.bulk_density},
         {"moving_density", m.moving_density}};
  if (m.stiffness) {
    Json rows = Json::array();
    for (int i = 0; i < 3; ++i) rows.push_back({(*m.stiffness)(i, 0), (*m.stiffness)(i, 1), (*m.stiffness)(i, 2)});
    j["stiffness"] = rows;
    const IsotropicModuli iso = *m.isotropic();
    j["young_modulus"] = iso.young();
    j["shear_modulus"] = iso.shear;
    j["bulk_modulus"] = iso.bulk;
    j["poisson_ratio"] = iso.poisson();
    const DirectionalSpeeds s = *m.speeds();
    j["bar_velocity"] = s.bar;
    j["shear_velocity"] = s.s;
    j["p_velocity"] = s.p;
  } else {
    for (const char* key : {"stiffness", "young_modulus", "shear_modulus", "bulk_modulus", "poisson_ratio", "shear_velocity", "p_velocity"}) {
      j[key] = nullptr;
      j[std::string(key) + "_status"] = m.method;
    }
    j["bar_velocity"] = m.strip->bar_velocity();
  }
  if (m.strip) {
    j["strip"] = {{"axial_stiffness", m.strip->axial_stiffness},
                  {"mass_per_length", m.strip->mass_per_length},
                  {"bar_velocity", m.strip->bar_velocity()}};
    if (const auto& contraction = m.strip->lateral_contraction) {
      j["strip"]["lateral_contraction"] = *contraction;
    } else {
      j["strip"]["lateral_contraction"] = nullptr;
      j["strip"]["lateral_contraction_status"] = "a single row of discs does not contract sideways";
    }
  }
  return j;
}

Json fem_json(const FemPlan& plan, const FemResult& r, const std::optional<WaveMeasurement>& measurement) {
  Json j{{"status", r.status},
         {"degree", r.degree},
         {"elements", r.elements},
         {"dofs", r.dofs},
         {"young_modulus", plan.fem.material.young_modulus},
         {"poisson_ratio", plan.fem.material.poisson_ratio},
         {"density", plan.fem.material.density},
         {"critical_time_step", number_or_status(r.critical_time_step, r.status)},
         {"time_step", number_or_status(r.time_step, r.status)},
         {"steps", r.steps},
         {"solve_seconds", r.solve_seconds},
         {"energy_drift", number_or_status(r.energy_drift, "not measured")},
         {"analytical_speed", plan.context.speed}};
  add_measurement(j, measurement, plan.layout, r.status == "ok" ? "the scene has no pairs of probes" : r.status);
  return j;
}

}  // namespace ddem::harness
