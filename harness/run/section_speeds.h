#pragma once
// What a long wave between the very sections of the probes should measure, from statics alone.

#include "dem/statics/moduli.h"
#include "harness/model/probes.h"

namespace ddem::harness {

/// Mean over the pairs of the static speed between their sections (dem/statics/sections.h), m/s: the reference of a mean
/// over the same pairs. The strip is the probes'. Throws as GrippedStrip::sections() and between().
StaticSections::Speeds section_speeds(const GrippedStrip& strip, const ProbeLayout& layout);

}  // namespace ddem::harness
