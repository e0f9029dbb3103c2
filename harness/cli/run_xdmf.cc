#include "harness/cli/run_xdmf.h"

#include <numeric>
#include <vector>

#include "harness/cli/xdmf.h"

namespace ddem::harness {
namespace {

std::vector<XdmfField> fields_of(const DemRun& run) {
  std::vector<XdmfField> fields = {{"displacement", {"displacement_x", "displacement_y"}},
                                   {"velocity", {"velocity_x", "velocity_y"}},
                                   {"rotation", {"rotation"}}};
  const auto add_tensor = [&](const std::string& name, const TensorField& tensor) {
    if (tensor.xx.empty()) return;
    for (const char* component : {"_xx", "_yy", "_xy"})
      fields.push_back({name + component, {name + component}});
  };
  add_tensor("stress", run.result.snapshots.front().stress);
  add_tensor("strain", run.result.snapshots.front().strain);
  return fields;
}

XdmfSeries series_of(const DemRun& run) {
  XdmfSeries series{"discs", "Polyvertex", "index", run.assembly.size(), run.assembly.size(), 1, {}, {"radius"}, fields_of(run)};
  for (const Snapshot& s : run.result.snapshots) series.times.push_back(s.time);
  return series;
}

}  // namespace

void write_points(Hdf5Group& root, const DemRun& run) {
  const Packing& p = run.assembly.packing;
  std::vector<double> position;
  for (std::size_t i = 0; i < p.size(); ++i) position.insert(position.end(), {p.x[i], p.y[i], 0.0});
  std::vector<int> index(p.size());
  std::iota(index.begin(), index.end(), 0);
  write_series(root, series_of(run), position, index);
}

std::string xdmf_text(const DemRun& run, const std::string& hdf5) {
  return xdmf_text(series_of(run), hdf5);
}

}  // namespace ddem::harness
