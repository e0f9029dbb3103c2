#include "harness/cli/fem_fields.h"

#include <vector>

#include "harness/cli/xdmf.h"

namespace ddem::harness {
namespace {

XdmfSeries series_of(const FemFields& f) {
  XdmfSeries series{"continuum", "Quadrilateral", "quadrilaterals", f.x.size(), f.quadrilaterals.size() / 4, 4, f.time, {}, {}};
  series.fields = {{"displacement", {"displacement_x", "displacement_y"}}, {"velocity", {"velocity_x", "velocity_y"}}};
  for (const char* component : {"stress_xx", "stress_yy", "stress_xy", "strain_xx", "strain_yy", "strain_xy"})
    series.fields.push_back({component, {component}});
  return series;
}

}  // namespace

void write_fem_fields(Hdf5Group& root, const FemFields& f) {
  Hdf5Group group = root.create_group("fields");
  group.write("time", f.time).set_attribute("unit", "s");
  for (const NamedFemField& field : named_fem_fields)
    group.write(field.name, f.*field.values, {f.time.size(), f.x.size()}).set_attribute("unit", field.unit);
  std::vector<double> position;
  for (std::size_t k = 0; k < f.x.size(); ++k) position.insert(position.end(), {f.x[k], f.y[k], 0.0});
  write_series(root, series_of(f), position, f.quadrilaterals);
}

std::string fem_xdmf_text(const FemFields& fields, const std::string& hdf5) {
  return xdmf_text(series_of(fields), hdf5);
}

}  // namespace ddem::harness
