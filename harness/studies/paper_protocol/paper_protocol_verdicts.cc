#include "harness/studies/paper_protocol/paper_protocol_verdicts.h"

#include <fmt/format.h>

#include "harness/studies/paper_protocol/paper_protocol_figures.h"
#include "harness/studies/strip/criteria.h"
#include "harness/studies/waves/pickers.h"

namespace ddem::harness {

using reports::Verdict;

Verdict paper_verdict(const StripResults& r, const StripMaterial& key) {
  Verdict v{.case_id = case_id("paper/random", key), .title = title_of(key, "The paper's protocol: column release, peak to peak")};
  // A column's wave has many crests, and where two are as high the pick is refused: half of the packings must do.
  const std::size_t seeds = (r.campaign.seeds.size() + 1) / 2;
  const auto s = speed_error(r, key, Protocol::paper, StripWave::shear, seeds, v);
  const auto b = speed_error(r, key, Protocol::paper, StripWave::bar, seeds, v);
  v.criteria = {judge("shear velocity over static", s, {0.0, -0.10, 0.06}, "",
                      "a released column sends waves as short as the discs: measured -2 +- 2 % elsewhere, four standard deviations allowed"),
                judge("bar velocity over static", b, {0.0, -0.25, 0.15}, "",
                      "S0 dispersion and single discs: measured -5 +- 6 % elsewhere, three standard deviations allowed")};
  const PaperPoisson steps = paper_poisson(r, key.model, key.stiffness_ratio);
  const double softening = 2.0 * (1.0 + steps.bulk) * 0.8 * steps.radius_over_width;
  v.criteria.push_back(judge("Poisson's ratio of the free strip and shear less that of the bulk, static", steps.strip - steps.bulk_bar,
                             {-softening, -3.0 * softening, -0.5 * softening}, "",
                             "free edges slow the bar by 0.8 radius/width (see the study of sizes: 0.75 to 0.9; up to 1.8 at coordination 4.75), and Poisson's ratio "
                             "loses 2 (1 + nu) times that"));
  conclude(v);
  return v;
}

}  // namespace ddem::harness
