#include "harness/run/laboratory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <stdexcept>

#include "dem/core/narrow.h"
#include "harness/measure/wave_speed.h"
#include "harness/run/laboratory_notes.h"
#include "harness/run/laboratory_pair.h"
#include "harness/run/laboratory_pick.h"
#include "harness/run/measurability.h"

namespace ddem::harness {
namespace {

void require_valid(const LaboratoryRecording& r, const LaboratoryOptions& o) {
  if (r.sensors.size() < 2) throw std::invalid_argument("a wave speed needs two sensors or more");
  if (!(r.dt > 0.0) || !std::isfinite(r.dt) || !std::isfinite(r.t0) || !(r.widest_gap > 0.0))
    throw std::invalid_argument("a recording needs a positive, finite step");
  std::set<double> positions;
  for (const LaboratorySensor& s : r.sensors) {
    if (s.values.size() != r.sensors.front().values.size())
      throw std::invalid_argument("the sensors of a recording have as many samples each");
    if (!std::isfinite(s.position) || !positions.insert(s.position).second)
      throw std::invalid_argument("sensors need different, finite positions");
  }
  if (o.density.has_value() != o.wave.has_value()) throw std::invalid_argument("a modulus needs a density and the kind of wave");
}

using Waves = std::vector<Outcome<ClearWave>>;

/// Sensors by position.
std::vector<std::size_t> along_the_way(const std::vector<LaboratorySensor>& sensors) {
  std::vector<std::size_t> order(sensors.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return sensors[a].position < sensors[b].position; });
  return order;
}

/// Neighbours, then every other sensor against the first.
std::vector<std::pair<std::size_t, std::size_t>> pairs_of(const std::vector<std::size_t>& order) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t k = 1; k < order.size(); ++k) pairs.emplace_back(order[k - 1], order[k]);
  for (std::size_t k = 2; k < order.size(); ++k) pairs.emplace_back(order[0], order[k]);
  return pairs;
}

class Laboratory {
 public:
  Laboratory(const LaboratoryRecording& recording, const LaboratoryOptions& options)
      : recording_(recording), options_(options), order_(along_the_way(recording.sensors)) {}

  LaboratoryResult measure() {
    find_waves();
    for (std::size_t s = 0; s < waves_.size(); ++s) result_.sensors.push_back(reading(s));
    for (const auto& [from, to] : pairs_of(order_)) result_.pairs.push_back(pair(from, to));
    confirm();
    for (const Mark mark : kMarks) result_.speed.push_back(mean(mark));
    if (options_.density) {
      for (const auto& speed : result_.speed) result_.modulus.push_back(modulus(speed));
    }
    result_.notes = notes_of(recording_, options_, result_);
    return std::move(result_);
  }

 private:
  /// A wave of the other sign than was said is named as such.
  Outcome<ClearWave> wave_as_said(std::size_t s) const {
    const Outcome<ClearWave> wave = wave_of(s, options_);
    if (wave.ok() || !options_.polarity) return wave;
    LaboratoryOptions open = options_;
    open.polarity.reset();
    const Outcome<ClearWave> other = wave_of(s, open);
    const double said = *options_.polarity == Polarity::negative ? -1.0 : 1.0;
    if (!other.ok() || other.value().sign() == said) return wave;
    return FailedMeasurement{Failure::below_noise,
                             fmt::format("its wave is {}, not {} as was said: turn the signal over, or leave the polarity open (auto)",
                                         said < 0.0 ? "positive" : "negative", said < 0.0 ? "negative" : "positive")};
  }

  Outcome<ClearWave> wave_of(std::size_t s, const LaboratoryOptions& options) const {
    const std::vector<double>& values = recording_.sensors[s].values;
    const double dt = recording_.dt;
    if (!options.band || !all_finite(values)) return clear_wave(values, values, dt, recording_.widest_gap, options);
    return clear_wave(values, band_pass(values, dt, *options.band), dt, recording_.widest_gap, options);
  }

  /// The first sensor with a wave chooses the crest, and its sign where that was not said; the others follow.
  void find_waves() {
    waves_.assign(recording_.sensors.size(), FailedMeasurement{});
    reversed_.assign(recording_.sensors.size(), false);
    const ClearWave* first = nullptr;
    for (const std::size_t s : order_) {
      waves_[s] = wave_as_said(s);
      if (!waves_[s].ok()) continue;
      if (first)
        follow(*first, s);
      else
        first = &waves_[s].value();
    }
  }

  void follow(const ClearWave& first, std::size_t s) {
    const ClearWave& own = waves_[s].value();
    const Outcome<Crest> crest = answering_crest(first, own, !options_.polarity);
    if (!crest.ok()) {
      waves_[s] = crest.error();
      return;
    }
    reversed_[s] = crest.value().sign != first.sign();
    const double moved = static_cast<double>(crest.value().index) - static_cast<double>(own.levelled.crest.index);
    if (crest.value().sign == own.sign() && std::abs(moved) < 0.5 * own.width) return;
    waves_[s] = with_crest(own, crest.value(), recording_.dt, recording_.widest_gap, options_);
  }

  /// Of all waves, in samples: every sensor is fitted over as much.
  double common_width() const {
    double sum = 0.0, count = 0.0;
    for (const auto& w : waves_) {
      if (w.ok()) sum += w.value().width, count += 1.0;
    }
    return sum / count;
  }

  /// From samples to seconds.
  Outcome<Uncertain> time(const Outcome<Uncertain>& samples) const {
    if (!samples.ok()) return samples;
    return Uncertain{recording_.t0 + samples.value().value * recording_.dt, samples.value().stddev * recording_.dt};
  }

  SensorReading reading(std::size_t s) const {
    if (!waves_[s].ok()) {
      const Outcome<Uncertain> none = waves_[s].error();
      return {0.0, 0.0, 0.0, 0.0, false, false, false, 0.0, 0.0, none, none, none};
    }
    const ClearWave& w = waves_[s].value();
    const Levelled& l = w.levelled;
    const double width = common_width(), dt = recording_.dt;
    std::optional<double> half_width;
    if (options_.source_duration) half_width = std::max(width, 0.55 * *options_.source_duration / dt);
    return {l.offset,
            l.trend / dt,
            l.noise,
            recording_.t0 + static_cast<double>(l.quiet) * dt,
            w.sign() < 0.0,
            reversed_[s],
            w.clipped,
            w.sign() * l.crest.height,
            w.width * dt,
            time(top_of(w, width)),
            time(first_break_of(w, width)),
            time(centroid_of(w, width, half_width))};
  }

  static Outcome<Uncertain> difference(const Outcome<Uncertain>& from, const Outcome<Uncertain>& to) {
    if (!from.ok()) return from;
    if (!to.ok()) return to;
    return Uncertain{to.value().value - from.value().value, std::hypot(from.value().stddev, to.value().stddev)};
  }

  PairReading failed(std::size_t from, std::size_t to, double distance, const FailedMeasurement& why) const {
    const std::vector<Outcome<Uncertain>> none(kMarks.size(), why);
    return {from, to, distance, none, none, why};
  }

  FailedMeasurement named(std::size_t s, const FailedMeasurement& failure) const {
    return {failure.failure, recording_.sensors[s].name + ": " + failure.reason};
  }

  PairReading pair(std::size_t from, std::size_t to) const {
    const double distance = recording_.sensors[to].position - recording_.sensors[from].position;
    for (const std::size_t s : {from, to}) {
      if (!waves_[s].ok()) return failed(from, to, distance, named(s, waves_[s].error()));
    }
    const ClearWave &a = waves_[from].value(), &b = waves_[to].value();
    const double width = 0.5 * (a.width + b.width);
    if (const auto different = different_waves(a, b)) return failed(from, to, distance, *different);
    Outcome<Uncertain> correlation = correlated_delay(a, b, width);
    if (!correlation.ok()) return failed(from, to, distance, correlation.error());
    correlation = Uncertain{correlation.value().value * recording_.dt, correlation.value().stddev * recording_.dt};
    if (const auto causal = causal_delay(correlation); !causal.ok()) return failed(from, to, distance, causal.error());

    const SensorReading &f = result_.sensors[from], &t = result_.sensors[to];
    PairReading out{from, to, distance, {}, {}, phase_velocity_of(a, b, width, recording_.dt, distance)};
    for (const Mark mark : kMarks) {
      const Outcome<Uncertain> delay = causal_delay(mark == Mark::peak          ? difference(f.peak, t.peak)
                                                    : mark == Mark::first_break ? difference(f.first_break, t.first_break)
                                                    : mark == Mark::centroid    ? difference(f.centroid, t.centroid)
                                                                                : correlation);
      out.delay.push_back(delay);
      out.speed.push_back(delay.ok()
                              ? Outcome<Uncertain>(Uncertain{distance / delay.value().value,
                                                             distance / delay.value().value * delay.value().stddev / delay.value().value})
                              : Outcome<Uncertain>(delay.error()));
    }
    return out;
  }

  /// A pick is a number only where another sensor saw the same wave.
  void confirm() {
    constexpr auto correlation = static_cast<std::size_t>(Mark::correlation);
    for (std::size_t s = 0; s < waves_.size(); ++s) {
      const bool seen = std::any_of(result_.pairs.begin(), result_.pairs.end(),
                                    [&](const PairReading& p) { return (p.from == s || p.to == s) && p.speed[correlation].ok(); });
      if (seen || !waves_[s].ok()) continue;
      const Outcome<Uncertain> none =
          FailedMeasurement{Failure::inconsistent, "no other sensor confirms this crest as a wave that passes: see the pairs"};
      SensorReading& r = result_.sensors[s];
      r.peak = r.first_break = r.centroid = none;
    }
  }

  Outcome<MeanSpeed> mean(Mark mark) const {
    const auto m = static_cast<std::size_t>(mark);
    std::vector<PairDelay> delays;
    double stddev = 0.0;
    std::string reasons;
    const FailedMeasurement* only = nullptr;
    for (const PairReading& p : result_.pairs) {
      delays.push_back({narrow<int>(p.from, "sensors"), narrow<int>(p.to, "sensors"), p.distance,
                        p.delay[m].ok() ? Outcome<double>(p.delay[m].value().value) : p.delay[m].error()});
      if (p.speed[m].ok()) {
        stddev += p.speed[m].value().stddev;
        continue;
      }
      only = &p.speed[m].error();
      reasons += fmt::format("; {} to {}: {}", recording_.sensors[p.from].name, recording_.sensors[p.to].name, only->reason);
    }
    if (only && result_.pairs.size() == 1) return *only;
    const WaveSpeed w = consistent(wave_speed(delays, delays.size() / 2 + 1));
    if (w.speed.ok())
      return MeanSpeed{w.speed.value().mean, stddev / static_cast<double>(w.good_pairs), w.speed.value().stddev, w.good_pairs};
    if (w.speed.error().failure != Failure::too_few_picks) return w.speed.error();
    return FailedMeasurement{Failure::too_few_picks, fmt::format("{} of {} pairs give a speed, and more than half are needed{}",
                                                                 w.good_pairs, delays.size(), reasons)};
  }

  Outcome<Uncertain> modulus(const Outcome<MeanSpeed>& speed) const {
    if (!speed.ok()) return speed.error();
    const Uncertain c{speed.value().mean, speed.value().stddev};
    switch (*options_.wave) {
      case LaboratoryWave::p:
        return p_modulus_from_p(*options_.density, c);
      case LaboratoryWave::shear:
        return shear_modulus_from_shear(*options_.density, c);
      case LaboratoryWave::bar:
        return young_modulus_from_bar(*options_.density, c);
    }
    return FailedMeasurement{};
  }

  const LaboratoryRecording& recording_;
  const LaboratoryOptions& options_;
  std::vector<std::size_t> order_;
  Waves waves_;
  std::vector<bool> reversed_;
  LaboratoryResult result_;
};

}  // namespace

LaboratoryResult measure_recording(const LaboratoryRecording& recording, const LaboratoryOptions& options) {
  require_valid(recording, options);
  return Laboratory(recording, options).measure();
}

}  // namespace ddem::harness
