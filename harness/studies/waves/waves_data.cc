#include "harness/studies/waves/waves_data.h"

#include <algorithm>

#include "harness/studies/strip/whole.h"

namespace ddem::harness {

Recording thinned(const Recording& recording) {
  constexpr std::size_t kSamples = 300;
  Recording out = recording;
  if (recording.signals.empty()) return out;
  const std::size_t stride = std::max<std::size_t>(1, recording.signals.front().values.size() / kSamples);
  out.sample_interval = recording.sample_interval * static_cast<double>(stride);
  for (PickedSignal& s : out.signals) {
    std::size_t kept = 0;
    for (std::size_t n = 0; n < s.values.size(); n += stride) s.values[kept++] = s.values[n];
    s.values.resize(kept);
  }
  return out;
}

void require_whole(const Recording& r) {
  if (r.signals.empty()) return;
  require(r.sample_interval > 0.0, "a recording without a sampling interval");
  const std::size_t samples = r.signals.front().values.size();
  require(samples > 0, "a recording without samples");
  for (const PickedSignal& s : r.signals) require_length("the signal of " + s.probe, s.values.size(), samples);
}

void require_whole(const WaveSet& found) {
  for (const WaveOutcome& w : found.waves) {
    require_whole(w.recording);
    require(!w.speed || *w.speed > 0.0, "a speed that is none");
  }
  if (!found.picture) return;
  const StripPicture& p = *found.picture;
  require_whole(p.packing);
  require_length("displacements of discs", p.displacement.size(), p.packing.x.size());
  require_length("y of probes", p.probe_y.size(), p.probe_x.size());
  require_length("labels of probes", p.probe_labels.size(), p.probe_x.size());
}

}  // namespace ddem::harness
