#include "fem_reference/snapshots.h"

#include <fmt/format.h>

#include <iterator>
#include <span>

#include "fem_reference/excitation.h"
#include "fem_reference/kernel/node_strains.h"

namespace ddem::fem {
namespace {

constexpr double most_field_bytes = 1e9;  // held twice, and one more time while the file is written

}  // namespace

SnapshotRecorder::SnapshotRecorder(const StripCase& strip, const StripModel& model, std::uint64_t steps, Fields& fields)
    : strip_(strip),
      model_(model),
      material_(plane_material(strip.young_modulus, strip.poisson_ratio, strip.density, strip.plane)),
      steps_(steps),
      fields_(fields) {
  if (strip.snapshots == 0) return;
  const double bytes = 8.0 * std::size(named_fields) * static_cast<double>(model.x.size()) * static_cast<double>(strip.snapshots);
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
  // From values of the nodes, `stride` a node, to those of the points.
  const auto append = [this](std::vector<double>& field, std::span<const double> values, std::size_t stride, std::size_t offset) {
    for (const std::uint32_t node : fields_.mesh.nodes) field.push_back(values[stride * node + offset]);
  };
  append(fields_.displacement_x, leapfrog.displacement(), 2, 0);
  append(fields_.displacement_y, leapfrog.displacement(), 2, 1);
  append(fields_.velocity_x, velocity, 2, 0);
  append(fields_.velocity_y, velocity, 2, 1);
  const NodeTensor strain = node_strains(model_.mesh, leapfrog.displacement());
  const NodeTensor stress = stresses(strain, material_);
  append(fields_.strain_xx, strain.xx, 1, 0);
  append(fields_.strain_yy, strain.yy, 1, 0);
  append(fields_.strain_xy, strain.xy, 1, 0);
  append(fields_.stress_xx, stress.xx, 1, 0);
  append(fields_.stress_yy, stress.yy, 1, 0);
  append(fields_.stress_xy, stress.xy, 1, 0);
}

}  // namespace ddem::fem
