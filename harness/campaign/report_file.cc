#include "harness/campaign/report_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <fstream>
#include <map>
#include <utility>
#include <vector>

#include "harness/campaign/write_results.h"
#include "harness/io/atomic_file.h"
#include "harness/io/digest.h"
#include "harness/io/errors.h"
#include "harness/io/json.h"
#include "harness/io/own_files.h"
#include "reports/figure_data.h"
#include "reports/report_json.h"
#include "reports/svg.h"
#include "reports/text.h"

namespace ddem::harness {
namespace {

constexpr std::int64_t kSchemaVersion = 1;
constexpr std::size_t kMarkedBytes = 4096;  // of a page, that its mark lies within

/// Equal arrays, such as the x of many series, are stored once. NaNs are never equal, and only cost space.
class ArrayStore {
 public:
  explicit ArrayStore(Hdf5Group group) : group_(std::move(group)) {}

  reports::Json put(const std::vector<double>& values) {
    const auto [place, is_new] = names_.try_emplace(values, fmt::format("{:04d}", names_.size()));
    if (is_new) group_.write(place->second, values);
    return place->second;
  }

 private:
  struct ByBits {
    bool operator()(const std::vector<double>& a, const std::vector<double>& b) const {
      return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) {
        return std::bit_cast<std::uint64_t>(x) < std::bit_cast<std::uint64_t>(y);
      });
    }
  };
  Hdf5Group group_;
  std::map<std::vector<double>, std::string, ByBits> names_;
};

reports::Report read_report(const Hdf5Group& stored) {
  const std::vector<std::string> structure = stored.read_strings("structure");
  if (structure.size() != 1) throw std::invalid_argument("structure: not one text");
  const Hdf5Group arrays = stored.group("arrays");
  const auto get = [&](const reports::Json& name) {
    return arrays.read_doubles(name.get<std::string>()).values;
  };
  return reports::report_from_json(parse_json(structure.front(), stored.place() + "/structure"), get);
}

constexpr const char* kRemedy = "`ddem validate -o FOLDER --resume` makes it again from the units in FOLDER";

Hdf5File open_results(const std::filesystem::path& path) {
  try {
    return Hdf5File::open(path);
  } catch (const InputError& e) {
    throw InputError(fmt::format("{}; {}", e.what(), kRemedy));
  }
}

/// plotly, which the build puts beside the program; empty where it could not be fetched: then figures are
/// SVG.
std::string plotting_library() {
  const std::filesystem::path library = shared_file("plotly-cartesian.min.js");
  return std::filesystem::exists(library) ? read_file(library) : std::string();
}

}  // namespace

void store_report(Hdf5Group& root, const reports::Report& report) {
  Hdf5Group group = root.create_group("report");
  group.set_attribute("schema_version", kSchemaVersion);
  ArrayStore arrays(group.create_group("arrays"));
  const reports::Json document =
      reports::to_json(report, [&](const std::vector<double>& values) { return arrays.put(values); });
  // Bytes that are not UTF-8, of a message of the system perhaps, must not cost the report.
  group.write("structure", std::vector<std::string>{
                               document.dump(-1, ' ', false, reports::Json::error_handler_t::replace)});
}

reports::Report load_report(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "results.h5";
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    throw InputError(path.string() + ": no such file; give the folder that `ddem validate -o FOLDER` wrote");
  }
  const Hdf5File file = open_results(path);
  const Hdf5Group root = file.root();
  if (!root.contains("report")) {
    throw InputError(
        path.string() +
        ": holds no report: an older ddem wrote it, or another program; run `ddem validate` again");
  }
  const Hdf5Group stored = root.group("report");
  if (const std::int64_t version = stored.int_attribute("schema_version"); version != kSchemaVersion) {
    throw InputError(
        fmt::format("{}: schema_version = {}, but this ddem draws {}; use the ddem that wrote it, or run "
                    "`ddem validate` again",
                    stored.place(), version, kSchemaVersion));
  }
  try {
    return read_report(stored);
  } catch (const reports::Json::exception& e) {
    throw InputError(fmt::format("{}/structure: not a report: {}; {}", stored.place(), in_words(e), kRemedy));
  } catch (const std::invalid_argument& e) {
    throw InputError(fmt::format("{}/structure: not a report: {}; {}", stored.place(), e.what(), kRemedy));
  }
}

std::string campaign_mark(const reports::Report& report) {
  Json marked{{"title", report.title}, {"summary", report.summary}, {"cases", Json::array()}};
  for (const reports::Verdict& v : report.verdicts) {
    // Units without a result come and go with what goes wrong.
    if (!v.case_id.starts_with("unit/")) marked["cases"].push_back(v.case_id);
  }
  return sha256(to_text(marked));
}

std::string drawn_campaign(const std::filesystem::path& folder) {
  std::string head(kMarkedBytes, '\0');
  std::ifstream file(folder / "report.html", std::ios::binary);
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  return reports::marked_campaign(head);
}

std::string draw_page(const reports::Report& report) {
  const std::string plotly = plotting_library();
  return reports::render_html(report, {.plotly = plotly, .campaign = campaign_mark(report)});
}

std::vector<ReportFile> draw_report(const reports::Report& report) {
  std::vector<ReportFile> drawings = {{"report.html", draw_page(report)}};
  for (const reports::Section& section : report.sections) {
    for (const reports::Figure& figure : section.figures) {
      // What a file says its figures are called must not lead out of the folder.
      const std::filesystem::path stem = std::filesystem::path("figures") / reports::slug(figure.id);
      drawings.push_back({stem.string() + ".svg", reports::render_svg(figure)});
      drawings.push_back({stem.string() + ".csv", reports::figure_csv(figure, reports::kAllRows).text});
    }
  }
  return drawings;
}

void write_report_files(const std::filesystem::path& folder, const std::vector<ReportFile>& files) {
  prepare_folder(folder / "figures");
  for (const ReportFile& f : files) write_file(folder / f.name, f.content);
}

}  // namespace ddem::harness
