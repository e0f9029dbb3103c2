#include "tests/harness/damage/kept_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "harness/campaign/report_file.h"
#include "harness/io/atomic_file.h"
#include "harness/io/errors.h"
#include "harness/model/packing_store.h"
#include "harness/nightly/baseline.h"
#include "harness/nightly/history.h"
#include "harness/nightly/plan.h"
#include "harness/nightly/unit_file.h"
#include "reports/report_json.h"

namespace ddem::harness::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCampaign = R"([strip]
seeds = [1, 2]
models = ["dem", "lagged-full"]
stiffness_ratios = [0.3]
discs = 300
columns = 40
rows = 4
length = "7.3 mm"
pulse_length = "4 mm"
)";

const packings::RandomSpec kPacking{.length = 4e-3, .width = 3e-3, .discs = 120, .seed = 5};

std::string text_of(const reports::Report& report) {
  const auto inline_array = [](const std::vector<double>& values) { return reports::Json(values); };
  return reports::to_json(report, inline_array).dump();
}

std::string text_of(const nightly::Night& night) {
  return night.time + to_text(nightly::summary_json(night.summary)) + std::to_string(night.work.steps) + std::to_string(night.work.units);
}

std::string text_of(const Packing& p) {
  std::string bytes;
  for (const auto* values : {&p.x, &p.y, &p.radius}) bytes.append(reinterpret_cast<const char*>(values->data()), values->size() * sizeof(double));
  return bytes;
}

}  // namespace

KeptFiles::KeptFiles() {
  ::setenv("XDG_CACHE_HOME", path("cache").c_str(), 1);
  write_file(*this / "campaign.toml", kCampaign);
  for (const char* night : {"night", "again"}) {
    std::vector<std::string> arguments = {"validate", path("campaign.toml"), "-o", path(night), "--history", path("nights")};
    if (std::string(night) == "again") arguments.push_back("--static");
    const SubprocessResult run = ddem(arguments);
    if (run.exit_code != 0 && run.exit_code != 1) throw std::runtime_error(run.status() + run.standard_error);
  }
  ddem({"baseline", "update", path("night"), "-o", path("baseline.json")});
  write_cached_packing(packing_cache_file(*this / "own", kPacking), kPacking, packings::random_jammed(kPacking));
}

SubprocessResult KeptFiles::ddem(const std::vector<std::string>& arguments) const {
  return run_program(DDEM_PROGRAM, arguments);
}

void KeptFiles::add_nights(std::vector<KeptFile>& files) const {
  for (const auto& entry : fs::directory_iterator(*this / "nights")) {
    if (entry.path().extension() != ".json") continue;
    files.push_back({entry.path(), [folder = *this / "nights"] {
                       std::string text;
                       for (const nightly::Night& n : nightly::read_history(folder)) text += text_of(n);
                       return text;
                     }});
  }
}

std::vector<KeptFile> KeptFiles::all() const {
  const fs::path night = *this / "night", baseline = *this / "baseline.json";
  std::vector<KeptFile> files = {
      {night / "results.h5", [night] { return text_of(load_report(night)); }},
      {night / "plan.json", [night] { return nightly::read_plan(night).digest(); }},
      {night / "summary.json", [night] { return to_text(nightly::summary_json(nightly::read_summary(night))); }},
      {baseline, [baseline] { return nightly::baseline_text(nightly::read_baseline(baseline)); }}};
  const fs::path packing = packing_cache_file(*this / "own", kPacking);
  files.push_back({packing, [packing] {
                     const auto found = read_cached_packing(packing, kPacking);
                     if (!found) throw InputError(packing.string() + ": made anew");
                     return text_of(*found);
                   }});
  add_nights(files);
  for (const nightly::Plan::Entry& unit : nightly::read_plan(night).units) {
    files.push_back({nightly::unit_path(night, unit.id),
                     [night, unit] { return nightly::to_bytes(nightly::read_unit(night, unit.id, unit.identity)); }});
  }
  return files;
}

const KeptFiles& kept_files() {
  static const KeptFiles files;
  return files;
}

}  // namespace ddem::harness::test
