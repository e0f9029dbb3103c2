#include "harness/studies/statics/statics_data.h"

#include "harness/studies/strip/whole.h"

namespace ddem::harness {

void require_whole(const StaticOutcome& found) {
  if (!found.failure.empty()) return;
  require(found.moduli.moving_density > 0.0, "a material without a density");
  for (const StripWave wave : {StripWave::bar, StripWave::shear, StripWave::p}) require(found.speeds.of(wave) > 0.0, "a static speed that is none");
}

}  // namespace ddem::harness
