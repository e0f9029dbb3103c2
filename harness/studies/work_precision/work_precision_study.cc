// Error against run time, briefly: a figure, and nothing that is judged.
#include "harness/bench/bench_report.h"
#include "harness/campaign/pieces.h"

namespace ddem::harness {
namespace bench {

DDEM_MEMBERS(PrecisionPoint, solver, scheme, mesh, discs_or_dofs, step_fraction, steps, seconds, error, error_to_continuum, status)

}  // namespace bench

namespace {

class WorkPrecisionStudy : public Study {
 public:
  WorkPrecisionStudy() {
    pieces_.push_back(piece(
        "work-precision", "", 150, [] { return bench::measure_briefly(); },
        [this](std::vector<bench::PrecisionPoint>&& found) {
          for (const bench::PrecisionPoint& p : found) {
            if (p.scheme.size() < 2) throw std::runtime_error("a measurement without a scheme");
          }
          points_ = std::move(found);
        },
        [](const std::string&) {}));
  }

  std::vector<reports::Section> sections() const override {
    if (points_.empty()) return {};
    return {bench::precision_section(points_)};
  }

  nlohmann::json data() const override { return {{"points", points_}}; }

 private:
  std::vector<bench::PrecisionPoint> points_;
};

}  // namespace

std::unique_ptr<Study> make_work_precision(const StudyContext&) {
  return std::make_unique<WorkPrecisionStudy>();
}

}  // namespace ddem::harness
