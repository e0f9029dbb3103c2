#include "fem_reference/snapshots.h"

#include <fmt/format.h>

#include "fem_reference/excitation.h"

namespace ddem::fem {
namespace {

constexpr double most_field_bytes = 1e9;  // held twice, and one more time while the file is written

}  // namespace

SnapshotRecorder::SnapshotRecorder(const StripCase& strip, const StripModel& model, std::uint64_t steps, Fields& fields)
    : strip_(strip), model_(model), steps_(steps), fields_(fields) {
  if (strip.snapshots == 0) return;
  const double bytes = 4.0 * 8.0 * static_cast<double>(model.x.size()) * static_cast<double>(strip.snapshots);
  if (!(bytes <= most_field_bytes)) {
    throw CaseError(fmt::format("case \"{}\", snapshots: {} of {} nodes make {:.3g} bytes of fields; {:.0e} are the most: take fewer",
                                strip.id, strip.snapshots, model.x.size(), bytes, most_field_bytes));
  }
  fields_.mesh = field_mesh(model);
}

void SnapshotRecorder::watch(const Leapfrog& leapfrog) {
  const std::uint64_t taken = fields_.time.size();
  if (taken >= strip_.snapshots || leapfrog.steps_done() * strip_.snapshots < (taken + 1) * steps_) return;
  fields_.time.push_back(leapfrog.time());
  std::vector<double> velocity = leapfrog.velocity();
  if (strip_.drive) {
    const double value = strip_.drive->amplitude * motion(*strip_.drive).rate(leapfrog.time());
    for (const std::uint32_t node : model_.left_nodes) velocity[2 * node + component(strip_.drive->wave)] = value;
  }
  for (const std::uint32_t node : fields_.mesh.nodes) {
    fields_.displacement_x.push_back(leapfrog.displacement()[2 * node]);
    fields_.displacement_y.push_back(leapfrog.displacement()[2 * node + 1]);
    fields_.velocity_x.push_back(velocity[2 * node]);
    fields_.velocity_y.push_back(velocity[2 * node + 1]);
  }
}

}  // namespace ddem::fem
