#pragma once
// Wave speeds from recordings of which nothing is known but where their sensors stand: of a laboratory, or of any other program.
//
// Every sensor by itself: the offset and, where it shows, the trend of the quiet part before the wave are removed. The wave is the
// first crest of half the height of the highest; it must stand six times above the noise, and so far that noise as scarce as the
// quiet part is long comes as high in one of 1000 cases (Student's t), and six times above all that comes before it. It takes four
// samples or more at half its height.
// Every pair: crests of a width, shapes that correlate at the delay of the crests, and a delay that is positive and beyond its noise.
// A pick is a number only where another sensor confirms the wave in this way.
//
// Each time has the standard deviation that the sensor's own noise gives it, of whatever colour: the pick is a weighted sum of
// samples, and the same sum over the quiet part has that spread; widened by Student's t where the quiet part is short.

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/measure/band_pass.h"
#include "harness/measure/elastic_constants.h"
#include "harness/measure/outcome.h"
#include "harness/measure/phase_velocity.h"
#include "harness/measure/picker.h"

namespace ddem::harness {

enum class LaboratoryWave { p, shear, bar };
std::string_view name(LaboratoryWave wave);
/// "M" of P waves, "G" of shear waves, "E" of bar waves: density times the square of their speed.
std::string_view modulus_symbol(LaboratoryWave wave);

/// By which mark of the wave it is timed.
enum class Mark { peak, first_break, centroid, correlation };
inline constexpr std::array kMarks = {Mark::peak, Mark::first_break, Mark::centroid, Mark::correlation};
std::string_view name(Mark mark);

struct LaboratorySensor {
  std::string name;
  double position = 0.0;       ///< along the wave's way, m
  std::vector<double> values;  ///< in any unit
};

struct LaboratoryRecording {
  double t0 = 0.0, dt = 0.0;  ///< s
  double widest_gap = 0.0;    ///< between the times as they were recorded, s; dt where they are uniform
  std::vector<LaboratorySensor> sensors;
};

struct LaboratoryOptions {
  std::optional<double> source_duration = {};  ///< of the pulse that was sent, s
  std::optional<Polarity> polarity = {};       ///< of the wave's first crest; left out: found
  std::optional<Band> band = {};
  std::optional<double> density = {};  ///< kg/m3
  std::optional<LaboratoryWave> wave = {};
};

/// What one sensor recorded. Times are s, with their standard deviation from noise.
struct SensorReading {
  double offset = 0.0, trend = 0.0;  ///< removed; the trend a second
  double noise = 0.0;                ///< root mean square of the quiet part, in the unit of the signal
  double quiet_end = 0.0;            ///< s
  bool negative = false;             ///< the wave's first crest
  bool reversed = false;             ///< against the first sensor
  bool clipped = false;
  double height = 0.0;  ///< of the crest, with its sign
  double width = 0.0;   ///< of the crest at half its height, s
  Outcome<Uncertain> peak, first_break, centroid;
};

struct PairReading {
  std::size_t from = 0, to = 0;                  ///< sensors, the nearer first
  double distance = 0.0;                         ///< m
  std::vector<Outcome<Uncertain>> delay, speed;  ///< by Mark; s, m/s
  Outcome<PhaseVelocity> phase_velocity;
};

struct MeanSpeed {
  double mean = 0.0;
  double stddev = 0.0;            ///< from noise, as if the pairs shared all of it: they share sensors
  std::optional<double> scatter;  ///< standard deviation of the pairs about their mean; a single pair has none
  std::size_t pairs = 0;
};

struct LaboratoryResult {
  std::vector<SensorReading> sensors;
  std::vector<PairReading> pairs;
  std::vector<Outcome<MeanSpeed>> speed;    ///< by Mark
  std::vector<Outcome<Uncertain>> modulus;  ///< by Mark; Pa. Empty without a density
  std::vector<std::string> notes;           ///< what was done to the signals, and what is odd about them
};

/// Neighbours, and every sensor against the first, in the order of their positions. Throws std::invalid_argument on fewer than two
/// sensors, signals of different lengths, positions that are not finite or equal, a step that is not positive, a density without a
/// wave or a wave without a density.
LaboratoryResult measure_recording(const LaboratoryRecording& recording, const LaboratoryOptions& options);

}  // namespace ddem::harness
