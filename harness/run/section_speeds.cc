#include "harness/run/section_speeds.h"

namespace ddem::harness {

StaticSections::Speeds section_speeds(const GrippedStrip& strip, const ProbeLayout& layout) {
  std::vector<SectionDiscs> sections;
  for (const Probe& p : layout.probes) sections.push_back(p.receiver.discs);
  const StaticSections statics = strip.sections(sections);
  StaticSections::Speeds mean;
  const double weight = 1.0 / static_cast<double>(layout.pairs.size());
  for (const ProbePair& pair : layout.pairs) {
    const StaticSections::Speeds speeds = statics.between(pair.from, pair.to);
    mean.p += weight * speeds.p;
    mean.s += weight * speeds.s;
    mean.bar += weight * speeds.bar;
  }
  return mean;
}

}  // namespace ddem::harness
