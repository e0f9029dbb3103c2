#pragma once
// What a campaign found: plain data from which verdicts, files and the report are made.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "dem/statics/moduli.h"
#include "harness/bench/precision.h"
#include "harness/campaign/bloch_limit.h"
#include "harness/campaign/calibration_study.h"
#include "harness/campaign/design_study.h"
#include "harness/campaign/discrimination_study.h"
#include "harness/campaign/dispersion_study.h"
#include "harness/campaign/range_study.h"
#include "harness/campaign/scheme_study.h"
#include "harness/campaign/stability_study.h"
#include "harness/campaign/size_study.h"
#include "harness/campaign/strip_campaign.h"
#include "harness/campaign/strip_film.h"
#include "harness/campaign/user_case.h"
#include "harness/measure/elastic_constants.h"
#include "harness/run/measure_wave.h"
#include "harness/run/scene_moduli.h"

namespace ddem::harness {

/// Which assembly with which contact law: everything but the wave.
struct StripMaterial {
  StripPacking packing = StripPacking::hexagonal;
  std::int64_t seed = 0;
  Model model = Model::dem;
  double stiffness_ratio = 0.0;

  bool operator==(const StripMaterial&) const = default;
};

struct Speeds {
  double bar = 0.0, shear = 0.0, p = 0.0;
  double of(StripWave wave) const { return wave == StripWave::bar ? bar : wave == StripWave::shear ? shear : p; }
};

/// References of one assembly and law, from static solves and closed forms.
struct StaticOutcome {
  StripMaterial key;
  std::string failure;  ///< empty: ok
  SceneModuli moduli;   ///< of the strip; bar from the pulled free strip
  Speeds speeds;        ///< static, directional
  Speeds sections;      ///< static, mean over the pairs of sections at which driven pulses are recorded; random packings only
  references::PlaneModuli kinematic;  ///< closed form: exact on the lattice, an estimate on a random packing
  Speeds kinematic_speeds;
  /// s; of rigid discs, edges closed above and below and no disc held: that of each wave's strip is as long or a little longer.
  double critical_time_step = 0.0;
  /// Hexagonal only: homogenised unit cell, to be compared with the closed form.
  std::optional<IsotropicModuli> cell;
  std::optional<BlochLimit> bloch;  ///< hexagonal only
  double solve_seconds = 0.0;       ///< wall time of the strip's moduli: both its edges, factorised and solved
};

struct PickedSignal {
  std::string probe;
  double x = 0.0;                     ///< m, from the source
  std::vector<double> values;         ///< m
  double window_end = 0.0;            ///< s: what follows is no first arrival
  std::optional<double> pick_time, pick_amplitude;
  std::string pick_failure;
};

/// A recording kept for the figures.
struct Recording {
  double sample_interval = 0.0;  ///< s
  std::vector<PickedSignal> signals;
};

/// Every so many samples, 300 to 600 of each signal: what is stored of a recording, and more than a figure shows.
Recording thinned(const Recording& recording);

/// One simulation.
struct WaveOutcome {
  StripCase c;
  std::string scene;    ///< its scene file
  std::string failure;  ///< why there is no speed; empty: ok
  bool diverged = false;
  long diverged_step = 0;
  int diverged_disc = 0;
  std::optional<double> speed, speed_stddev;  ///< peak to peak, m/s, over its pairs of probes
  std::optional<double> centroid_speed, correlation_speed;  ///< of driven pulses, m/s
  PickedSpeeds s0;  ///< a driven bar's: what S0 makes of the static speed
  int good_pairs = 0;
  double static_speed = 0.0, kinematic_speed = 0.0;
  double section_speed = 0.0;  ///< static, between the same sections; 0 on the lattice and for single discs
  double time_step = 0.0, critical_time_step = 0.0;
  long steps = 0;
  double seconds = 0.0;  ///< wall time, the mean of its material's waves
  Recording recording;
};

/// The lattice, periodic in x and y, released from noise: does the published scheme hold?
struct StabilityOutcome {
  StripMaterial key;
  std::string failure;
  bool expected_unstable = false;
  std::optional<long> diverged_step;
  long steps = 0;
};

/// One finite-element run: the continuum with the static moduli of an assembly.
struct FemOutcome {
  StripMaterial key;
  StripWave wave = StripWave::shear;
  bool uniaxial = false;  ///< the same bar with nu = 0, which is not dispersive: checks the program itself
  std::string failure;
  std::optional<double> speed;
  double analytical_speed = 0.0;
  long dofs = 0, steps = 0;
  double solve_seconds = 0.0;
  Recording recording;
};

/// The random strip of the first seed, for its picture: positions, the displacement half-way through a column release
/// (bar), and the probes of the paper's protocol.
struct StripPicture {
  Packing packing;
  double time = 0.0;  ///< s
  std::vector<double> displacement;
  std::vector<double> probe_x, probe_y;
  std::vector<std::string> probe_labels;
};

struct CampaignResults {
  StripCampaign campaign;
  bool has_strip = true;  ///< false: the campaign has the user's cases only
  std::vector<CaseResult> cases;
  std::vector<StaticOutcome> statics;
  std::vector<WaveOutcome> waves;
  std::vector<StabilityOutcome> stability;
  std::vector<FemOutcome> fem;
  std::optional<SchemeStudy> schemes;  ///< empty: not asked for
  std::optional<RangeStudy> range;
  std::vector<CalibrationOutcome> calibrations;  ///< one each of calibration_cases()
  std::optional<DesignStudy> design;
  std::vector<bench::PrecisionPoint> work_precision;  ///< of a small measurement, for the report's figure; no verdict
  std::vector<StabilityMap> stability_maps;
  std::optional<DispersionStudy> dispersion;
  std::optional<SizeStudy> sizes;
  std::optional<DiscriminationStudy> discrimination;
  std::map<std::string, std::string> failed_units;  ///< which gave no result, and why; each is an ERROR of its own
  std::string fem_failure;  ///< why there are no finite-element results at all
  StripPicture picture;
  std::optional<StripFilm> film;
  double wall_seconds = 0.0;

  /// Whether the strip's waves were to be run.
  bool has_waves() const { return !waves.empty(); }
  const StaticOutcome* find(const StripMaterial& key) const;
  const WaveOutcome* find(const StripCase& c) const;
  /// The continuum of that material: see continuum_model().
  const FemOutcome* find(const StripMaterial& material, StripWave wave) const;
};

/// The model whose static moduli stand for a model's: lagged and implicit strains have the same equilibrium, and the
/// continuum is run once for both.
Model continuum_model(const StripCampaign& campaign, Model model);

/// Mean and standard deviation of the sample (n - 1).
Uncertain sample_statistics(const std::vector<double>& values);

/// Whether theory says that the published scheme is unstable there: on the lattice beyond the fixed-point limit, or N
/// with k_t/k_n above 1/3 (theory section 3); on random packings nothing exact is known.
bool expected_unstable(const StripCampaign& campaign, const StripMaterial& key);

}  // namespace ddem::harness
