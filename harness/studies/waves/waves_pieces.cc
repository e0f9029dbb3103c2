#include "harness/studies/waves/waves_pieces.h"

#include <chrono>

#include "harness/campaign/pieces.h"
#include "harness/studies/strip/outside_members.h"
#include "harness/studies/waves/waves_run.h"

namespace ddem::harness {
namespace {

/// Of a released column's short waves a figure shows every sample, at one ratio; driven pulses are smooth.
void keep_shown(const StripCampaign& s, std::vector<WaveOutcome>& waves) {
  for (WaveOutcome& w : waves) {
    const bool whole = w.c.protocol == Protocol::paper && w.c.stiffness_ratio == shown_ratio(s);
    if (!whole) w.recording = thinned(w.recording);
  }
}

}  // namespace

Piece wave_piece(const std::shared_ptr<Strip>& strip, const StripMaterial& m, Protocol protocol,
                 const std::function<void(StripPicture&&)>& on_picture) {
  std::vector<WaveOutcome*> places;
  for (const StripCase& c : cases_of(m, protocol)) {
    places.push_back(&strip->found.waves.emplace_back());
    places.back()->c = c;
    places.back()->failure = kNotRun;
  }
  const auto run = [strip, m, protocol] {
    strip->statics.of(m);  // kept: the clock is for the waves
    const auto start = std::chrono::steady_clock::now();
    WaveSet found = send_waves(strip->spec, m, protocol, strip->statics, strip->options);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    for (WaveOutcome& w : found.waves) w.seconds = elapsed.count() / static_cast<double>(found.waves.size());
    keep_shown(strip->spec, found.waves);
    return found;
  };
  const auto take = [places, on_picture](WaveSet&& found) {
    require_same(found.waves.size() == places.size());
    for (std::size_t n = 0; n < places.size(); ++n) require_same(found.waves[n].c == places[n]->c);
    for (std::size_t n = 0; n < places.size(); ++n) *places[n] = std::move(found.waves[n]);
    if (found.picture && on_picture) on_picture(std::move(*found.picture));
  };
  const auto miss = [places](const std::string& reason) {
    for (WaveOutcome* w : places) w->failure = reason;
  };
  return piece(waves_unit(m, protocol), inputs_of(strip->spec, m), protocol == Protocol::paper ? 1 : 3, run, take, miss);
}

/// Without what its name says, and what it has not got.
nlohmann::json stored_wave(const WaveOutcome& w) {
  nlohmann::json j = w;
  j.erase("c");
  if (!w.diverged) {
    for (const char* member : {"diverged", "diverged_step", "diverged_disc"}) j.erase(member);
  }
  if (w.section_speed == 0.0) j["section_speed"] = nullptr;
  if (w.recording.signals.empty()) j.erase("recording");
  if (!w.s0.peak && !w.s0.centroid && !w.s0.correlation) j.erase("s0");
  return j;
}

nlohmann::json stored_waves(const StripResults& r, Protocol protocol) {
  nlohmann::json j = nlohmann::json::object();
  for (WaveOutcome w : r.waves) {
    if (w.c.protocol != protocol) continue;
    w.recording = thinned(w.recording);
    j[id_of(w.c)] = stored_wave(w);
  }
  return j;
}

void count_waves(const StripResults& r, Protocol protocol, nightly::WorkCounts& work) {
  work.seeds = r.campaign.seeds;
  for (const WaveOutcome& w : r.waves) {
    if (w.c.protocol != protocol) continue;
    ++work.simulations;
    work.steps += w.steps;
  }
}

}  // namespace ddem::harness
