#include "harness/cli/run_xdmf.h"

#include <fmt/format.h>

#include <numeric>
#include <string_view>
#include <vector>

#include "harness/io/errors.h"

namespace ddem::harness {
namespace {

struct PointField {
  std::string name;
  std::vector<std::string> components;  ///< datasets of /fields
  bool is_vector() const { return components.size() > 1; }
};

std::vector<PointField> fields_of(const DemRun& run) {
  std::vector<PointField> fields = {{"displacement", {"displacement_x", "displacement_y"}},
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

std::string frame_name(std::size_t k) {
  return fmt::format("{:04d}", k);
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text)
    out += c == '<' ? "&lt;" : c == '&' ? "&amp;" : c == '"' ? "&quot;" : std::string(1, c);
  return out;
}

}  // namespace

std::filesystem::path xdmf_path(const std::filesystem::path& hdf5) {
  // A reader takes what follows the first colon for the place inside the file.
  if (hdf5.filename().string().find(':') != std::string::npos) {
    throw InputError(hdf5.string() + ": XDMF cannot name a file with a colon; choose another name");
  }
  return std::filesystem::path(hdf5).replace_extension(".xdmf");
}

void write_points(Hdf5Group& root, const DemRun& run) {
  const Packing& p = run.assembly.packing;
  std::vector<double> position;
  for (std::size_t i = 0; i < p.size(); ++i) position.insert(position.end(), {p.x[i], p.y[i], 0.0});
  std::vector<int> index(p.size());
  std::iota(index.begin(), index.end(), 0);
  Hdf5Group points = root.create_group("points");
  points.write("position", position, {p.size(), 3}).set_attribute("unit", "m");
  points.write("index", index, {p.size(), 1});
  for (std::size_t k = 0; k < run.result.snapshots.size(); ++k) {
    Hdf5Group frame = points.create_group(frame_name(k));
    for (const PointField& f : fields_of(run)) {
      std::vector<Hdf5Row> rows;
      for (const std::string& component : f.components) rows.push_back({"/fields/" + component, k});
      frame.write_view(f.name, rows, f.is_vector() ? 3 : 1);
    }
  }
}

std::string xdmf_text(const DemRun& run, const std::string& hdf5) {
  const std::size_t n = run.assembly.size();
  const std::string file = escaped(hdf5);
  const auto item = [&](std::size_t columns, std::string_view type, std::string_view place) {
    return fmt::format("<DataItem Dimensions=\"{}{}\" {} Format=\"HDF\">{}:{}</DataItem>", n,
                       columns == 1 ? std::string() : fmt::format(" {}", columns), type, file, place);
  };
  constexpr std::string_view real = "NumberType=\"Float\" Precision=\"8\"";
  // Every grid has its points, not a reference to the first one's: more readers understand that.
  const std::string mesh = fmt::format(
      "      <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{}\" NodesPerElement=\"1\">\n        "
      "<DataItem Dimensions=\"{} 1\" NumberType=\"Int\" Precision=\"4\" "
      "Format=\"HDF\">{}:/points/index</DataItem>\n      </Topology>\n      <Geometry "
      "GeometryType=\"XYZ\">\n        {}\n      </Geometry>\n",
      n, n, file, item(3, real, "/points/position"));
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n"
      "  <Grid Name=\"discs over time\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  const auto attribute = [&](std::string_view name, bool is_vector, const std::string& place) {
    text += fmt::format(
        "      <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Node\">\n        {}\n      "
        "</Attribute>\n",
        name, is_vector ? "Vector" : "Scalar", item(is_vector ? 3 : 1, real, place));
  };
  for (std::size_t k = 0; k < run.result.snapshots.size(); ++k) {
    text += fmt::format("    <Grid Name=\"discs\" GridType=\"Uniform\">\n      <Time Value=\"{:.17g}\"/>\n{}",
                        run.result.snapshots[k].time, mesh);
    attribute("radius", false, "/fields/radius");
    for (const PointField& f : fields_of(run))
      attribute(f.name, f.is_vector(), fmt::format("/points/{}/{}", frame_name(k), f.name));
    text += "    </Grid>\n";
  }
  return text + "  </Grid>\n</Domain>\n</Xdmf>\n";
}

}  // namespace ddem::harness
