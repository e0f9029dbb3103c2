// Where each scheme is stable, predicted and measured; and whether the lattice holds when it is released from noise.
#include <deque>

#include "harness/campaign/pieces.h"
#include "harness/studies/stability/noise_release.h"
#include "harness/studies/stability/stability_figures.h"
#include "harness/studies/strip/outside_members.h"
#include "harness/studies/strip/strip.h"

namespace ddem::harness {
namespace {

std::string noise_unit(const StripMaterial& m) { return "noise/" + slug_of(m); }
std::string map_unit(const StabilityKey& key) { return "stability-map/" + slug(key); }

class StabilityStudy : public Study {
 public:
  explicit StabilityStudy(const std::shared_ptr<Strip>& strip) {
    const StripCampaign& s = strip->spec;
    for (const StripMaterial& m : lattices_with_strain(s)) {
      noise_.push_back({.key = m, .failure = kNotRun, .expected_unstable = expected_unstable(s, m), .diverged_step = {}});
      pieces_.push_back(piece_at(
          noise_.back(), noise_unit(m), inputs_of(s, m), 1, [strip, m] { return release_noise(strip->spec, m, strip->options); },
          [](const StabilityOutcome& planned, const StabilityOutcome& found) { return planned.key == found.key; }));
    }
    const auto grid = std::make_shared<StabilityGrid>(stability_grid(s.full_stability));
    grid->solver = strip->options.solver;
    maps_.resize(grid->maps.size());
    for (std::size_t k = 0; k < maps_.size(); ++k) {
      maps_[k].key = grid->maps[k];
      maps_[k].failure = kNotRun;
      pieces_.push_back(piece_at(
          maps_[k], map_unit(maps_[k].key), inputs_of(s), 14, [strip, grid, k] { return map_stability(strip->spec, *grid, grid->maps[k]); },
          [](const StabilityMap& planned, const StabilityMap& found) { return slug(planned.key) == slug(found.key); }));
    }
  }

  std::vector<Judged> judge() const override {
    std::vector<Judged> judged;
    for (const StabilityOutcome& o : noise_) judged.push_back({noise_verdict(o), {noise_unit(o.key)}});
    for (const StabilityMap& map : maps_) judged.push_back({stability_map_verdict(map), {map_unit(map.key)}});
    return judged;
  }

  std::vector<reports::Section> sections() const override {
    return {{.heading = "Stability",
          .paragraphs = {"A step of any of these schemes is a linear map. Its eigenvalues say how fast which motion grows: on the lattice "
                         "they come from plane "
                         "waves, in a small random packing from the matrix itself. The very schemes are then run, and what they do is "
                         "measured. Prediction and "
                         "measurement must agree within 2 %, and noise must blow up where it should, and nowhere else."},
          .figures = stability_figures(maps_),
          .tables = {stability_table(maps_)}}};
  }

  nlohmann::json data() const override {
    nlohmann::json j{{"noise", nlohmann::json::object()}, {"maps", nlohmann::json::object()}};
    for (const StabilityOutcome& o : noise_) j["noise"][slug_of(o.key)] = o;
    for (const StabilityMap& map : maps_) j["maps"][slug(map.key)] = map;
    return j;
  }

 private:
  std::deque<StabilityOutcome> noise_;
  std::vector<StabilityMap> maps_;
};

}  // namespace

std::unique_ptr<Study> make_stability(const StudyContext& context) {
  return std::make_unique<StabilityStudy>(strip_of(context));
}

}  // namespace ddem::harness
