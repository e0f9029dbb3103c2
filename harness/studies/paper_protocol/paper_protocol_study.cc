// The column release of the paper, peak to peak between single discs, and what it makes of Poisson's ratio.
#include "harness/campaign/pieces.h"
#include "harness/studies/paper_protocol/paper_protocol_figures.h"
#include "harness/studies/paper_protocol/paper_protocol_verdicts.h"
#include "harness/studies/waves/speed_table.h"
#include "harness/studies/waves/waves_figures.h"
#include "harness/studies/waves/waves_pieces.h"

namespace ddem::harness {
namespace {

class PaperProtocolStudy : public Study {
 public:
  explicit PaperProtocolStudy(std::shared_ptr<Strip> strip) : strip_(std::move(strip)) {
    for (const StripMaterial& m : materials_of(strip_->spec)) {
      if (m.packing == StripPacking::random) pieces_.push_back(wave_piece(strip_, m, Protocol::paper));
    }
  }

  std::vector<Judged> judge() const override {
    std::vector<Judged> judged;
    for (const StripMaterial& m : contacts_of(strip_->spec, StripPacking::random)) {
      judged.push_back({paper_verdict(strip_->found, m), {}});
      for (const StripMaterial& seed : all_seeds(strip_->spec, m)) {
        judged.back().units.push_back(statics_unit(seed));
        judged.back().units.push_back(waves_unit(seed, Protocol::paper));
      }
    }
    return judged;
  }

  std::vector<reports::Section> sections() const override {
    const StripResults& r = strip_->found;
    return {{.heading = kWaves, .figures = {paper_figure(r)}},
            {.heading = "The paper's protocol, and its bias",
      .paragraphs =
          {"The discs of the left edge are displaced and let go; velocities are measured peak to peak between single discs, bar between "
           "free "
           "edges, shear between periodic ones, and Poisson's ratio follows from c_bar² = 2 (1 + ν) c_shear². Three things come between "
           "that number "
           "and the material's.",
           "First the free edges: bonds are missing there, the layer along them is softer, and a strip few discs wide is slower than its "
           "own bulk: by 4 to 5 % at nine discs and a coordination of 5.8. No measuring can take that out, since it is a property of the "
           "strip; it lowers ν by "
           "2 (1 + ν) times as much, 0.08 to 0.13 there, and it vanishes in proportion to radius over width. Second the waves: a released "
           "column sends waves as short as the discs, "
           "which the packing scatters and delays, and the bar disperses (S0), at fixed width whatever the size of the discs; what the "
           "peak of "
           "a single disc shows is off by some per cent either way, from packing to packing. Third the anisotropy of a single packing, for "
           "which bar and shear along one "
           "direction do not belong to one ν.",
           "P and shear velocities between periodic edges have none of the first error, and driven long pulses, averaged over sections, "
           "little of the second: "
           "hence the headline is measured with them. The first table compares velocities with the static ones of the same strips, the "
           "second "
           "follows Poisson's ratio from the material to the protocol."},
      .figures = {paper_poisson_figure(r)},
      .tables = {speed_table(r, Protocol::paper), paper_poisson_table(r)}}};
  }

  nlohmann::json data() const override { return stored_waves(strip_->found, Protocol::paper); }

  void count(nightly::WorkCounts& work) const override { count_waves(strip_->found, Protocol::paper, work); }

 private:
  std::shared_ptr<Strip> strip_;
};

}  // namespace

std::unique_ptr<Study> make_paper_protocol(const StudyContext& context) {
  return std::make_unique<PaperProtocolStudy>(strip_of(context));
}

}  // namespace ddem::harness
