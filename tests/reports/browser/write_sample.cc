// write_sample FOLDER PLOTLY: the report with one of everything, and the trends of 30 nights, for the test in a browser.
#include <filesystem>
#include <fstream>
#include <iterator>

#include "harness/nightly/history_figures.h"
#include "reports/figure_data.h"
#include "tests/harness/nightly/made_up_nights.h"
#include "tests/reports/full_report.h"

int main(int argc, char** argv) {
  using namespace ddem::reports;
  if (argc != 3) return 2;
  const std::filesystem::path folder = argv[1];
  std::ifstream library(argv[2]);
  const std::string plotly{std::istreambuf_iterator<char>(library), {}};
  Report report = test::full_report();
  report.sections.push_back(ddem::harness::nightly::history_section(ddem::harness::nightly::made_up_nights(30)));
  std::filesystem::create_directories(folder / "figures");
  std::ofstream(folder / "report.html") << render_html(report, {.plotly = plotly});
  for (const Section& section : report.sections) {
    for (const Figure& f : section.figures) std::ofstream(folder / "figures" / (f.id + ".csv")) << figure_csv(f, kAllRows).text;
  }
  return plotly.empty() ? 1 : 0;
}
