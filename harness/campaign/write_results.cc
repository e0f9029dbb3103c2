#include "harness/campaign/write_results.h"

#include <algorithm>
#include <future>
#include <iterator>

#include "harness/campaign/report_file.h"
#include "harness/io/claim_outputs.h"
#include "harness/io/hdf5.h"
#include "harness/io/json.h"
#include "harness/io/store_data.h"
#include "harness/nightly/summary.h"
#include "harness/provenance/provenance.h"
#include "reports/junit.h"

namespace ddem::harness {
namespace {

std::vector<std::pair<std::string, std::string>> provenance_of(const CampaignResults& r) {
  auto all = provenance();
  if (!r.solver.empty()) all.emplace_back("solver", r.solver);
  return all;
}

void write_hdf5(const std::filesystem::path& target, const CampaignResults& r, const reports::Report& report) {
  Hdf5File file = Hdf5File::create(target);
  {
    Hdf5Group root = file.root();
    root.set_attribute("title", report.title);
    root.set_attribute("units", "SI");
    for (const auto& [key, value] : provenance_of(r)) root.set_attribute(key, value);
    for (const PlannedStudy& s : r.studies) {
      const nlohmann::json data = s.study->data();
      if (!data.is_object()) continue;
      Hdf5Group group = root.create_group(std::string(s.entry->id));
      store_data(group, data);
    }
    store_report(root, report);
  }
  file.close();
}

}  // namespace

void prepare_folder(const std::filesystem::path& folder) {
  claim_folder(folder);
}

void write_results(const std::filesystem::path& folder, const CampaignResults& r, const reports::Report& report) {
  // Drawn while results.h5 is written; the files come after it, so that a full disk leaves no report of other results.
  std::future<std::vector<ReportFile>> rest = std::async(std::launch::async, [&] {
    const Json summary = nightly::summary_json({report.title, r.wall_seconds, provenance_of(r), report.verdicts});
    std::vector<ReportFile> files{{"summary.json", to_text(sealed(summary))}, {"junit.xml", reports::render_junit("ddem validate", report.verdicts)}};
    std::ranges::move(draw_report(report), std::back_inserter(files));
    return files;
  });
  write_hdf5(folder / "results.h5", r, report);
  write_report_files(folder, rest.get());
}

}  // namespace ddem::harness
