#pragma once
// The default campaign: the strip of the paper, DEM and DDEM over k_t/k_n, measured in waves and compared with static
// moduli, closed forms and the continuum. What is run, as plain data; no results.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "harness/io/members.h"
#include "harness/scene/scene.h"

namespace ddem::harness {

/// Plain DEM; the published (lagged) scheme with either correction; the full correction with strains of the same step.
enum class Model { dem, lagged_normal, lagged_full, implicit_full };

enum class StripPacking { hexagonal, random };

enum class Protocol {
  long_wave,  ///< driven edge, signals averaged over cross-sections
  paper       ///< column release, single discs, peak to peak
};

enum class StripWave { bar, shear, p };

struct StripCampaign {
  std::string title = "The strip of the paper";
  std::vector<double> stiffness_ratios = {0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0};
  std::vector<Model> models = {Model::dem, Model::lagged_normal, Model::lagged_full, Model::implicit_full};
  std::vector<std::int64_t> seeds = {1, 2, 3, 4, 5, 6};

  double length = 16.5e-3, width = 2e-3;  ///< m
  std::int64_t discs = 682;               ///< of a random strip
  std::int64_t columns = 68, rows = 10;   ///< of the hexagonal one, close-packed rows along x
  double coordination = 5.8;              ///< of a random strip
  double density = 2000.0;                ///< of a disc, kg/m3
  double normal_stiffness = 1e10;         ///< N/m
  double particle_modulus = 4e10;         ///< E_p, Pa
  double particle_poisson_ratio = 0.45;   ///< nu_p
  /// Of the critical time step: spacing of the signals, and the step of lagged strains. Rigid discs and implicit strains
  /// are marched exactly in time.
  double step_fraction = 0.2;
  double long_wave_step_fraction = 0.4;   ///< of driven long pulses
  double pulse_length = 8e-3;             ///< of the driven pulse in the strip, m (support)
  std::int64_t fem_degree = 4;
  std::array<std::int64_t, 2> fem_elements = {33, 4};  ///< along x and y: 0.5 mm each, for pulses of 8 mm
  bool full_stability = false;  ///< the study of stability over all of its grid: many minutes
};

DDEM_LAST_ENUMERATOR(Model, implicit_full)
DDEM_LAST_ENUMERATOR(StripPacking, random)
DDEM_LAST_ENUMERATOR(Protocol, paper)
DDEM_LAST_ENUMERATOR(StripWave, p)
DDEM_MEMBERS(StripCampaign, title, stiffness_ratios, models, seeds, length, width, discs, columns, rows, coordination, density,
             normal_stiffness, particle_modulus, particle_poisson_ratio, step_fraction, long_wave_step_fraction, pulse_length,
             fem_degree, fem_elements, full_stability)

/// One simulation of the campaign.
struct StripCase {
  StripPacking packing = StripPacking::hexagonal;
  std::int64_t seed = 0;  ///< of a random packing
  Model model = Model::dem;
  double stiffness_ratio = 0.0;
  Protocol protocol = Protocol::long_wave;
  StripWave wave = StripWave::shear;

  bool operator==(const StripCase&) const = default;
};

DDEM_MEMBERS(StripCase, packing, seed, model, stiffness_ratio, protocol, wave)

std::string name(Model model);       ///< "DEM", "DDEM N", "DDEM F", "DDEM F implicit"
std::string name(StripWave wave);    ///< "bar", "shear", "P"
std::string material_slug(Model model, double stiffness_ratio);  ///< "lagged-full/kt0.30": the end of a verdict's name
std::string id_of(const StripCase& c);  ///< "long-wave/random-1/lagged-full/kt0.30/shear"

/// The scene file of a case. `speed` (m/s) turns the pulse's length into the drive's duration.
std::string scene_text(const StripCampaign& campaign, const StripCase& c, double speed);
/// The scene of its assembly without load, for static moduli; `cell`: periodic in x and y.
std::string assembly_text(const StripCampaign& campaign, const StripCase& c, bool cell);

/// Parses a text made by the two functions above. Throws std::logic_error if it is not a valid scene.
Scene scene_of(const std::string& text, const std::string& name);

}  // namespace ddem::harness
