#include "harness/cli/fem_fields.h"

#include <vector>

#include "harness/cli/xdmf.h"

namespace ddem::harness {
namespace {

XdmfSeries series_of(const FemFields& f) {
  return {"continuum",
          "Quadrilateral",
          "quadrilaterals",
          f.x.size(),
          f.quadrilaterals.size() / 4,
          4,
          f.time,
          {},
          {{"displacement", {"displacement_x", "displacement_y"}}, {"velocity", {"velocity_x", "velocity_y"}}}};
}

}  // namespace

void write_fem_fields(Hdf5Group& root, const FemFields& f) {
  Hdf5Group group = root.create_group("fields");
  group.write("time", f.time).set_attribute("unit", "s");
  const auto write = [&](const char* name, const char* unit, const std::vector<double>& values) {
    group.write(name, values, {f.time.size(), f.x.size()}).set_attribute("unit", unit);
  };
  write("displacement_x", "m", f.displacement_x);
  write("displacement_y", "m", f.displacement_y);
  write("velocity_x", "m/s", f.velocity_x);
  write("velocity_y", "m/s", f.velocity_y);
  std::vector<double> position;
  for (std::size_t k = 0; k < f.x.size(); ++k) position.insert(position.end(), {f.x[k], f.y[k], 0.0});
  write_series(root, series_of(f), position, f.quadrilaterals);
}

std::string fem_xdmf_text(const FemFields& fields, const std::string& hdf5) {
  return xdmf_text(series_of(fields), hdf5);
}

}  // namespace ddem::harness
