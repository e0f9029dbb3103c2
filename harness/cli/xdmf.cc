#include "harness/cli/xdmf.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "harness/io/errors.h"
#include "harness/io/json.h"

namespace ddem::harness {
namespace {

std::string frame_name(std::size_t k) {
  return fmt::format("{:04d}", k);
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text)
    out += c == '<' ? "&lt;" : c == '&' ? "&amp;" : c == '"' ? "&quot;" : std::string(1, c);
  return out;
}

/// Readers drop blanks at the ends, line breaks among them.
bool is_xml_text(const std::string& name) {
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20; };
  if (name.empty() || name.front() == ' ' || name.back() == ' ' || std::any_of(name.begin(), name.end(), is_control)) return false;
  try {
    [[maybe_unused]] const std::string valid = Json(name).dump();
    return true;
  } catch (const Json::exception&) {  // not UTF-8
    return false;
  }
}

}  // namespace

std::filesystem::path xdmf_path(const std::filesystem::path& hdf5) {
  if (!is_xml_text(hdf5.filename().string())) {
    throw InputError(hdf5.string() + ": XDMF cannot name a file with control characters or bytes that are not UTF-8; choose another name");
  }
  // A reader takes what follows the first colon for the place inside the file.
  if (hdf5.filename().string().find(':') != std::string::npos) {
    throw InputError(hdf5.string() + ": XDMF cannot name a file with a colon; choose another name");
  }
  return std::filesystem::path(hdf5).replace_extension(".xdmf");
}

void write_series(Hdf5Group& root, const XdmfSeries& series, const std::vector<double>& position, const std::vector<int>& cells) {
  Hdf5Group points = root.create_group("points");
  points.write("position", position, {series.points, 3}).set_attribute("unit", "m");
  points.write(series.cells_dataset, cells, {series.cells, series.nodes_per_cell});
  for (std::size_t k = 0; k < series.times.size(); ++k) {
    Hdf5Group frame = points.create_group(frame_name(k));
    for (const XdmfField& f : series.fields) {
      std::vector<Hdf5Row> rows;
      for (const std::string& component : f.components) rows.push_back({"/fields/" + component, k});
      frame.write_view(f.name, rows, f.is_vector() ? 3 : 1);
    }
  }
}

std::string xdmf_text(const XdmfSeries& series, const std::string& hdf5) {
  const std::string file = escaped(hdf5);
  const auto item = [&](std::size_t columns, std::string_view type, std::string_view place) {
    return fmt::format("<DataItem Dimensions=\"{}{}\" {} Format=\"HDF\">{}:{}</DataItem>", series.points,
                       columns == 1 ? std::string() : fmt::format(" {}", columns), type, file, place);
  };
  constexpr std::string_view real = "NumberType=\"Float\" Precision=\"8\"";
  // Every grid has its mesh, not a reference to the first one's: more readers understand that.
  const std::string mesh = fmt::format(
      "      <Topology TopologyType=\"{}\" NumberOfElements=\"{}\" NodesPerElement=\"{}\">\n        "
      "<DataItem Dimensions=\"{} {}\" NumberType=\"Int\" Precision=\"4\" "
      "Format=\"HDF\">{}:/points/{}</DataItem>\n      </Topology>\n      <Geometry "
      "GeometryType=\"XYZ\">\n        {}\n      </Geometry>\n",
      series.topology, series.cells, series.nodes_per_cell, series.cells, series.nodes_per_cell, file, series.cells_dataset,
      item(3, real, "/points/position"));
  std::string text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n"
      "  <Grid Name=\"{} over time\" GridType=\"Collection\" CollectionType=\"Temporal\">\n",
      series.name);
  const auto attribute = [&](std::string_view name, bool is_vector, const std::string& place) {
    text += fmt::format(
        "      <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Node\">\n        {}\n      "
        "</Attribute>\n",
        name, is_vector ? "Vector" : "Scalar", item(is_vector ? 3 : 1, real, place));
  };
  for (std::size_t k = 0; k < series.times.size(); ++k) {
    text += fmt::format("    <Grid Name=\"{}\" GridType=\"Uniform\">\n      <Time Value=\"{:.17g}\"/>\n{}", series.name,
                        series.times[k], mesh);
    for (const std::string& name : series.constants) attribute(name, false, "/fields/" + name);
    for (const XdmfField& f : series.fields)
      attribute(f.name, f.is_vector(), fmt::format("/points/{}/{}", frame_name(k), f.name));
    text += "    </Grid>\n";
  }
  return text + "  </Grid>\n</Domain>\n</Xdmf>\n";
}

}  // namespace ddem::harness
