#pragma once
// Does a calibration hold on packings that it has not seen, and in motion? Per seed: static moduli, a driven
// shear and a P pulse between periodic edges, each against the static speed of the very strip that it runs
// through, and how much slower the free strip's bar is than the bulk.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/calibrate/calibrate.h"

namespace ddem::harness {

/// A pulse in one packing. Speeds in m/s; `failure` where there is none.
struct ProofWave {
  double section_speed = 0.0;            ///< static, between the very sections of the probes
  double static_speed = 0.0;             ///< static, of the whole packing
  std::optional<double> peak, centroid;  ///< measured, mean over the pairs
  std::string failure;
};

struct ProofSeed {
  std::int64_t seed = 0;
  double young_modulus = 0.0, poisson_ratio = 0.0;
  std::optional<ProofWave> shear, p;  ///< none where the assembly has no ends to send a wave from
  /// sqrt(E/rho) of the bulk along x, and the static speed of the same strip with free edges.
  double bulk_bar = 0.0;
  std::optional<double> strip_bar;
};

struct Proof {
  std::vector<ProofSeed> seeds;
  bool unseen = true;    ///< false: the packing has no seeds, so it is the fitted one
  std::string no_waves;  ///< why there are none
  double seconds = 0.0;  ///< without packings
};

/// On `count` seeds from `first` on (one packing where it has no seeds). A scene periodic in x is given ends,
/// if it is random. `on_progress` is told of each seed. Throws as calibrate().
Proof prove(const Scene& scene, const FoundParameters& found, std::int64_t first, int count, int threads,
            const std::function<void()>& on_progress);

/// measured over section speed - 1, mean over the seeds that have both; empty for none.
std::optional<MeanWithConfidence> dynamic_deviation(const Proof& proof,
                                                    std::optional<ProofWave> ProofSeed::*wave,
                                                    std::optional<double> ProofWave::*measured);

/// static speed of the free strip over the bulk's bar speed - 1.
std::optional<MeanWithConfidence> bar_bias(const Proof& proof);

}  // namespace ddem::harness
