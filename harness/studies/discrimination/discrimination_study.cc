// Wrong parameters, and the cases that must find them.
#include "harness/campaign/pieces.h"
#include "harness/studies/discrimination/discrimination_data.h"
#include "harness/studies/strip/strip.h"

namespace ddem::harness {
namespace {

constexpr const char* kDiscriminationUnit = "discrimination";

class DefectsStudy : public Study {
 public:
  explicit DefectsStudy(const std::shared_ptr<Strip>& strip) {
    pieces_.push_back(piece_at(study_, kDiscriminationUnit, inputs_of(strip->spec) + (strip->options.with_continuum ? " with the continuum" : ""), 150,
                               [strip] { return study_discrimination(strip->spec, strip->options.with_continuum); }));
  }

  std::vector<Judged> judge() const override { return {{discrimination_verdict(study_.value_or(DiscriminationStudy{})), {kDiscriminationUnit}}}; }

  std::vector<reports::Section> sections() const override {
    if (!study_) return {};
    return {{.heading = "Would an error be noticed?",
             .paragraphs = {"Parameters are made wrong by 1 and 5 % in what the solvers are given, while the references keep the right ones."},
             .tables = {discrimination_table(*study_)}}};
  }

  nlohmann::json data() const override { return study_; }

 private:
  std::optional<DiscriminationStudy> study_;
};

}  // namespace

std::unique_ptr<Study> make_discrimination(const StudyContext& context) {
  return std::make_unique<DefectsStudy>(strip_of(context));
}

}  // namespace ddem::harness
