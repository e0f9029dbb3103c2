// write_sample FOLDER PLOTLY: the report with one of everything, for the test in a browser.
#include <filesystem>
#include <fstream>
#include <iterator>

#include "reports/figure_data.h"
#include "tests/reports/full_report.h"

int main(int argc, char** argv) {
  using namespace ddem::reports;
  if (argc != 3) return 2;
  const std::filesystem::path folder = argv[1];
  std::ifstream library(argv[2]);
  const std::string plotly{std::istreambuf_iterator<char>(library), {}};
  const Report report = test::full_report();
  std::filesystem::create_directories(folder / "figures");
  std::ofstream(folder / "report.html") << render_html(report, {.plotly = plotly});
  for (const Figure& f : report.sections[0].figures)
    std::ofstream(folder / "figures" / (f.id + ".csv")) << figure_csv(f, kAllRows).text;
  return plotly.empty() ? 1 : 0;
}
