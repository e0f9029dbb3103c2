#pragma once
// What a long wave between the very sections of the probes should measure, from statics alone.

#include "dem/statics/sections.h"
#include "harness/model/probes.h"
#include "harness/scene/scene.h"

namespace ddem::harness {

/// Mean over the pairs of the static speed between their sections (dem/statics/sections.h), m/s: the reference of a mean
/// over the same pairs. `assembly` is that of the scene. Throws as static_sections() and between().
StaticSections::Speeds section_speeds(const Scene& scene, const ddem::Assembly& assembly, const ProbeLayout& layout);

}  // namespace ddem::harness
