#include "harness/campaign/write_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <future>

#include "harness/campaign/report_content.h"
#include "harness/campaign/report_file.h"
#include "harness/io/atomic_file.h"
#include "harness/io/errors.h"
#include "harness/io/hdf5.h"
#include "harness/io/json.h"
#include "harness/nightly/summary.h"
#include "harness/provenance/provenance.h"
#include "reports/junit.h"

namespace ddem::harness {
namespace {

void set_finite(Hdf5Group& g, const std::string& name, std::optional<double> value) {
  if (value && std::isfinite(*value)) g.set_attribute(name, *value);
}

/// signals: probe x sample; a pick that failed has its reason in pick_status and is not in pick_time.
void write_recording(Hdf5Group& parent, const Recording& whole) {
  if (whole.signals.empty()) return;
  const Recording recording = thinned(whole);
  std::vector<double> values, distance, pick_time, pick_amplitude;
  std::vector<std::string> probes, pick_status;
  for (const PickedSignal& s : recording.signals) {
    values.insert(values.end(), s.values.begin(), s.values.end());
    probes.push_back(s.probe);
    distance.push_back(s.x);
    pick_status.push_back(s.pick_time ? "ok" : s.pick_failure);
    pick_time.push_back(s.pick_time.value_or(0.0));
    pick_amplitude.push_back(s.pick_amplitude.value_or(0.0));
  }
  Hdf5Group g = parent.create_group("recording");
  Hdf5Dataset signals = g.write("signals", values, {recording.signals.size(), values.size() / recording.signals.size()});
  signals.set_attribute("unit", "m");
  signals.set_attribute("sample_interval", recording.sample_interval);
  g.write("probes", probes);
  g.write("distance_from_source", distance).set_attribute("unit", "m");
  g.write("pick_status", pick_status);
  g.write("pick_time", pick_time).set_attribute("unit", "s, where pick_status is ok");
  g.write("pick_amplitude", pick_amplitude).set_attribute("unit", "m, where pick_status is ok");
}

/// Slashes in an identity would make nested groups.
std::string group_name(std::string id) {
  std::replace(id.begin(), id.end(), '/', ':');
  return id;
}

void write_wave(Hdf5Group& parent, const WaveOutcome& w) {
  Hdf5Group g = parent.create_group(group_name(id_of(w.c)));
  g.set_attribute("scene", w.scene);
  g.set_attribute("status", w.failure.empty() ? std::string("ok") : w.failure);
  set_finite(g, "wave_speed", w.speed);
  set_finite(g, "wave_speed_stddev", w.speed_stddev);
  set_finite(g, "wave_speed_by_centroid", w.centroid_speed);
  set_finite(g, "wave_speed_by_correlation", w.correlation_speed);
  set_finite(g, "static_speed", w.static_speed);
  if (w.section_speed > 0.0) set_finite(g, "static_speed_between_sections", w.section_speed);
  set_finite(g, "s0_speed", w.s0.peak);
  set_finite(g, "s0_speed_by_centroid", w.s0.centroid);
  set_finite(g, "s0_speed_by_correlation", w.s0.correlation);
  set_finite(g, "kinematic_speed", w.kinematic_speed);
  set_finite(g, "time_step", w.time_step);
  set_finite(g, "critical_time_step", w.critical_time_step);
  g.set_attribute("steps", static_cast<std::int64_t>(w.steps));
  write_recording(g, w.recording);
}

/// Plain attributes, SI units.
void write_statics(Hdf5Group& parent, const StaticOutcome& s) {
  const std::string packing = s.key.packing == StripPacking::hexagonal ? "hexagonal" : fmt::format("random-{}", s.key.seed);
  Hdf5Group g = parent.create_group(group_name(packing + "/" + material_slug(s.key.model, s.key.stiffness_ratio)));
  g.set_attribute("status", s.failure.empty() ? std::string("ok") : s.failure);
  if (!s.failure.empty()) return;
  for (const StripWave wave : {StripWave::bar, StripWave::shear, StripWave::p}) {
    set_finite(g, fmt::format("static_{}_speed", name(wave)), s.speeds.of(wave));
    set_finite(g, fmt::format("kinematic_{}_speed", name(wave)), s.kinematic_speeds.of(wave));
    if (s.key.packing == StripPacking::random) set_finite(g, fmt::format("static_{}_speed_between_sections", name(wave)), s.sections.of(wave));
  }
  if (s.bloch) {
    set_finite(g, "bloch_shear_speed", s.bloch->shear);
    set_finite(g, "bloch_P_speed", s.bloch->p);
  }
  set_finite(g, "solve_seconds", s.solve_seconds);
}

void write_stability(Hdf5Group& parent, const StabilityOutcome& o) {
  Hdf5Group g = parent.create_group(group_name(material_slug(o.key.model, o.key.stiffness_ratio)));
  g.set_attribute("status", !o.failure.empty() ? o.failure : o.diverged_step ? fmt::format("diverged at step {}", *o.diverged_step) : "stable");
  g.set_attribute("expected", o.expected_unstable ? "unstable" : "stable");
  g.set_attribute("steps", static_cast<std::int64_t>(o.steps));
}

void write_fem(Hdf5Group& parent, const FemOutcome& f) {
  const StripCase c{f.key.packing, f.key.seed, f.key.model, f.key.stiffness_ratio, Protocol::long_wave, f.wave};
  Hdf5Group g = parent.create_group(group_name(id_of(c)) + (f.uniaxial ? ":uniaxial" : ""));
  g.set_attribute("status", f.failure.empty() ? std::string("ok") : f.failure);
  set_finite(g, "wave_speed", f.speed);
  set_finite(g, "analytical_speed", f.analytical_speed);
  g.set_attribute("dofs", static_cast<std::int64_t>(f.dofs));
  g.set_attribute("steps", static_cast<std::int64_t>(f.steps));
  set_finite(g, "solve_seconds", f.solve_seconds);
  write_recording(g, f.recording);
}

/// energy/CURVE: time, energy over its first value; reach/CURVE: k_n/E_p, Poisson's ratio (where status is ok), closed form;
/// order/CURVE: step over critical, error.
void write_schemes(Hdf5Group& parent, const SchemeStudy& study) {
  parent.set_attribute("status", study.failure.empty() ? std::string("ok") : study.failure);
  Hdf5Group energy = parent.create_group("energy"), reach = parent.create_group("reach"), order = parent.create_group("order");
  for (const EnergyCurve& c : study.energy) {
    Hdf5Group g = energy.create_group(fmt::format("{}, step {:g}", c.scheme, c.step_fraction));
    set_finite(g, "energy_drift", c.drift);
    g.set_attribute("status", c.drift ? "ok" : "diverged");
    g.write("time", c.time).set_attribute("unit", "s");
    g.write("energy", c.energy);
  }
  for (const ReachCurve& c : study.reach) {
    Hdf5Group g = reach.create_group(c.scheme);
    std::vector<double> softness, poisson, closed;
    std::vector<std::string> status;
    for (const ReachPoint& p : c.points) {
      softness.push_back(p.softness), closed.push_back(p.closed_form);
      poisson.push_back(p.poisson.value_or(0.0));
      status.push_back(p.poisson ? "ok" : "no speed: unstable");
    }
    g.write("softness", softness);
    g.write("poisson_ratio", poisson);
    g.write("status", status);
    g.write("closed_form", closed);
  }
  for (const OrderCurve& c : study.order) {
    Hdf5Group g = order.create_group(c.scheme);
    g.write("step_fraction", c.step_fraction);
    g.write("error", c.error);
  }
}

/// softness; for each nu_p the lowest and highest Poisson's ratio, one a softness.
void write_range(Hdf5Group& parent, const RangeStudy& study) {
  parent.set_attribute("status", study.failure.empty() ? std::string("ok") : study.failure);
  set_finite(parent, "rigid_lowest", study.rigid.lowest);
  set_finite(parent, "rigid_highest", study.rigid.highest);
  parent.write("softness", study.softness);
  for (const RangeCurve& c : study.curves) {
    Hdf5Group g = parent.create_group(fmt::format("particle_poisson_ratio {:g}", c.particle_poisson_ratio));
    std::vector<double> lowest, highest;
    for (const PoissonRange& p : c.ranges) lowest.push_back(p.lowest), highest.push_back(p.highest);
    g.write("lowest", lowest);
    g.write("highest", highest);
  }
}

/// One group a case: what was found, and the moduli of fitted and other packings with it.
void write_calibrations(Hdf5Group& parent, const std::vector<CalibrationOutcome>& outcomes) {
  for (const CalibrationOutcome& o : outcomes) {
    Hdf5Group g = parent.create_group(group_name(o.id));
    g.set_attribute("status", o.failure.empty() ? std::string("ok") : o.failure);
    if (!o.failure.empty()) continue;
    g.set_attribute("target_young_modulus", o.target_young);
    g.set_attribute("target_poisson_ratio", o.target_poisson);
    g.set_attribute("feasible", static_cast<std::int64_t>(o.feasible));
    g.set_attribute("stiffness_ratio", o.stiffness_ratio);
    g.set_attribute("normal_stiffness", o.normal_stiffness);
    if (o.softness > 0.0) {
      g.set_attribute("softness", o.softness);
      g.set_attribute("particle_poisson_ratio", o.particle_poisson_ratio);
    }
    const auto write = [&](const std::string& which, const std::vector<CalibratedPacking>& packings) {
      if (packings.empty()) return;
      std::vector<double> seed, young, poisson;
      for (const CalibratedPacking& p : packings)
        seed.push_back(static_cast<double>(p.seed)), young.push_back(p.young_modulus), poisson.push_back(p.poisson_ratio);
      g.write(which + "_seed", seed);
      g.write(which + "_young_modulus", young).set_attribute("unit", "Pa");
      g.write(which + "_poisson_ratio", poisson);
    };
    write("fitted", o.fitted);
    write("unseen", o.unseen);
  }
}

/// softness; for each nu_p E/k_n and nu, one a softness, of the first random packing and of the lattice.
void write_design(Hdf5Group& parent, const DesignStudy& study) {
  parent.set_attribute("stiffness_ratio", study.stiffness_ratio);
  parent.write("softness", study.softness);
  for (const SoftnessCurve& c : study.curves) {
    Hdf5Group g = parent.create_group(fmt::format("particle_poisson_ratio {:g}", c.particle_poisson_ratio));
    const auto write = [&](const std::string& which, const std::vector<DesignPoint>& points) {
      std::vector<double> young, poisson;
      for (const DesignPoint& p : points) young.push_back(p.young_over_stiffness), poisson.push_back(p.poisson_ratio);
      g.write(which + "_young_over_stiffness", young).set_attribute("unit", "1/m");
      g.write(which + "_poisson_ratio", poisson);
    };
    write("random", c.random);
    write("lattice", c.lattice);
  }
}

/// One group a strip: bias/strip_speed, bulk_speed, one a stiffness ratio; measured speeds, their static reference and S0.
void write_sizes(Hdf5Group& parent, const SizeStudy& study) {
  parent.write("stiffness_ratios", study.stiffness_ratios);
  for (const SizedStrip& s : study.strips) {
    Hdf5Group g = parent.create_group(fmt::format("{}, refined {}, seed {}", s.packing == StripPacking::random ? "random" : "hexagonal", s.refinement, s.seed));
    g.set_attribute("status", s.failure.empty() ? std::string("ok") : s.failure);
    if (!s.failure.empty()) continue;
    g.set_attribute("discs", s.discs);
    g.set_attribute("cells", static_cast<std::int64_t>(s.cells));
    g.set_attribute("radius_over_width", s.radius_over_width);
    std::vector<double> strip, bulk;
    for (const WidthBias& b : s.bias) strip.push_back(b.strip), bulk.push_back(b.bulk);
    g.write("bar_speed_of_strip", strip).set_attribute("unit", "m/s, static");
    g.write("bar_speed_of_bulk", bulk).set_attribute("unit", "m/s, static");
    for (const StripWave wave : {StripWave::bar, StripWave::shear, StripWave::p}) {
      const SizedWave& w = s.wave(wave);
      Hdf5Group h = g.create_group(name(wave));
      set_finite(h, "wave_speed", w.measured.peak);
      set_finite(h, "wave_speed_by_centroid", w.measured.centroid);
      set_finite(h, "wave_speed_by_correlation", w.measured.correlation);
      set_finite(h, "static_speed", w.reference);
      set_finite(h, "s0_over_static", w.s0.peak);
      set_finite(h, "s0_over_static_by_centroid", w.s0.centroid);
      set_finite(h, "s0_over_static_by_correlation", w.s0.correlation);
    }
  }
}

void write_hdf5(const std::filesystem::path& target, const CampaignResults& r, const reports::Report& report) {
  AtomicFile atomic(target);
  Hdf5File file = Hdf5File::create(atomic.temporary_path());
  {
    Hdf5Group root = file.root();
    root.set_attribute("title", r.campaign.title);
    for (const auto& [key, value] : provenance()) root.set_attribute(key, value);
    Hdf5Group statics = root.create_group("statics");
    for (const StaticOutcome& s : r.statics) write_statics(statics, s);
    Hdf5Group waves = root.create_group("waves");
    for (const WaveOutcome& w : r.waves) write_wave(waves, w);
    Hdf5Group stability = root.create_group("stability");
    for (const StabilityOutcome& o : r.stability) write_stability(stability, o);
    Hdf5Group fem = root.create_group("finite_elements");
    for (const FemOutcome& f : r.fem) write_fem(fem, f);
    if (r.schemes) {
      Hdf5Group schemes = root.create_group("schemes");
      write_schemes(schemes, *r.schemes);
    }
    if (r.range) {
      Hdf5Group range = root.create_group("poisson_range");
      write_range(range, *r.range);
    }
    if (!r.calibrations.empty()) {
      Hdf5Group calibrations = root.create_group("calibrations");
      write_calibrations(calibrations, r.calibrations);
    }
    if (r.design) {
      Hdf5Group design = root.create_group("design_curves");
      write_design(design, *r.design);
    }
    if (r.sizes) {
      Hdf5Group sizes = root.create_group("sizes");
      write_sizes(sizes, *r.sizes);
    }
    Hdf5Group strip = root.create_group("strip");
    strip.write("x", r.picture.packing.x).set_attribute("unit", "m");
    strip.write("y", r.picture.packing.y).set_attribute("unit", "m");
    strip.write("radius", r.picture.packing.radius).set_attribute("unit", "m");
    strip.write("displacement", r.picture.displacement).set_attribute("unit", "m");
    store_report(root, report);
  }
  file.close();
  atomic.commit();
}

}  // namespace

void prepare_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw MachineError(folder.string() + ": cannot create the folder: " + error.message());
}

void write_results(const std::filesystem::path& folder, const CampaignResults& r, const std::vector<reports::Verdict>& verdicts,
                   const std::vector<reports::Section>& more) {
  const reports::Report report = report_of(r, verdicts, more);
  // Drawn while results.h5 is written; the files come after it, so that a full disk leaves no report of other results.
  std::future<std::vector<ReportFile>> rest = std::async(std::launch::async, [&] {
    const Json summary = nightly::summary_json({r.campaign.title, r.wall_seconds, provenance(), verdicts});
    std::vector<ReportFile> files{{"summary.json", to_text(summary)}, {"junit.xml", reports::render_junit("ddem validate", verdicts)}};
    std::ranges::move(draw_report(report), std::back_inserter(files));
    return files;
  });
  write_hdf5(folder / "results.h5", r, report);
  write_report_files(folder, rest.get());
}

}  // namespace ddem::harness
