// The strip of the paper out of smaller discs.
#include <fmt/format.h>

#include "harness/campaign/pieces.h"
#include "harness/studies/sizes/sizes_figures.h"
#include "harness/studies/sizes/sizes_verdicts.h"
#include "harness/studies/strip/strip.h"

namespace ddem::harness {
namespace {

class SizesStudy : public Study {
 public:
  explicit SizesStudy(const std::shared_ptr<Strip>& strip) : study_(plan_sizes(strip->spec)) {
    for (std::size_t k = 0; k < study_.strips.size(); ++k) {
      SizedStrip& place = study_.strips[k];
      place.failure = kNotRun;
      const auto run = [strip, k, ratios = study_.stiffness_ratios.size()] {
        SizeStudy study = plan_sizes(strip->spec);
        measure_strip(strip->spec, study, k, *strip->options.solver);
        return study.strips[k];
      };
      pieces_.push_back(piece_at(place, unit_of(place), inputs_of(strip->spec), work_of(place), run,
                                 [ratios = study_.stiffness_ratios.size()](const SizedStrip& planned, const SizedStrip& found) {
                                   require_whole(found, ratios);
                                   return found.packing == planned.packing && found.refinement == planned.refinement && found.seed == planned.seed;
                                 }));
    }
  }

  std::vector<Judged> judge() const override {
    if (study_.strips.empty()) return {};
    std::vector<std::string> units;
    for (const SizedStrip& s : study_.strips) units.push_back(unit_of(s));
    return {{size_bias_verdict(study_), units}, {size_wave_verdict(study_), units}};
  }

  std::vector<reports::Section> sections() const override {
    if (study_.strips.empty()) return {};
    return {{.heading = "Smaller discs",
      .paragraphs =
          {"The strip of the paper is nine discs wide. The same strip out of smaller discs shows which errors are those of its width in "
           "discs. "
           "The largest is static: the free edges soften the bar, in proportion to radius over width, so that its speed is not that of the "
           "material. Strips of 16 times as many discs repeat one jammed cell, as wide as the strip; the table says how many copies."},
      .figures = {size_figure(study_)},
      .tables = {size_table(study_)}}};
  }

  nlohmann::json data() const override {
    nlohmann::json j{{"stiffness_ratios", study_.stiffness_ratios}};
    for (const SizedStrip& s : study_.strips) j[unit_of(s)] = s;
    return j;
  }

 private:
  static std::string unit_of(const SizedStrip& s) {
    const std::string packing = s.packing == StripPacking::hexagonal ? "hexagonal" : fmt::format("random-{}", s.seed);
    return fmt::format("sizes/{}/refined-{}", packing, s.refinement);
  }
  static std::size_t work_of(const SizedStrip& s) { return static_cast<std::size_t>(2 * s.refinement * s.refinement * s.refinement); }

  SizeStudy study_;
};

}  // namespace

std::unique_ptr<Study> make_sizes(const StudyContext& context) {
  return std::make_unique<SizesStudy>(strip_of(context));
}

}  // namespace ddem::harness
