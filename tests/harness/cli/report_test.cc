// ddem report: what validate wrote is drawn again from results.h5 alone, to the byte; anything else is
// refused and changes nothing.

#include "harness/io/hdf5.h"
#include "tests/harness/cli/program.h"

namespace ddem::harness::test {
namespace {

using testing::HasSubstr;

class ReportCommand : public Cli {
 protected:
  /// A small campaign's folder: one case, no studies.
  void validate() const {
    write("small.toml",
          "[strip]\nseeds = [1, 2]\nmodels = [\"dem\"]\nstiffness_ratios = [0.3]\ndiscs = 300\nlength = "
          "\"7.3 mm\"\npulse_length = \"4 mm\"\n");
    const auto run =
        ddem({"validate", path("small.toml"), "-o", path("night"), "--only", "static/hexagonal/dem/kt0.30"});
    ASSERT_EQ(run.exit_code, 0) << run.standard_error;
  }

  /// `ddem report night` ends with 2, says so, prints nothing and changes nothing.
  void expect_report_refused(const std::string& message) const {
    const auto before = contents();
    const auto run = ddem({"report", path("night")});
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_THAT(run.standard_error, HasSubstr(message));
    EXPECT_THAT(run.standard_error, HasSubstr("results.h5"));
    EXPECT_EQ(run.standard_output, "");
    expect_contents(before);
  }
};

TEST_F(ReportCommand, DrawsTheSameBytesFromResultsAlone) {
  validate();
  std::filesystem::create_directory(in_folder("moved"));
  std::filesystem::copy_file(in_folder("night/results.h5"), in_folder("moved/results.h5"));
  const auto run = ddem({"report", path("moved"), "-o", path("again")});
  ASSERT_EQ(run.exit_code, 0) << run.standard_error;
  EXPECT_EQ(read("again/report.html"), read("night/report.html"));
  int figures = 0;
  for (const auto& entry : std::filesystem::directory_iterator(in_folder("night/figures"))) {
    const std::string name = "figures/" + entry.path().filename().string();
    EXPECT_EQ(read("again/" + name), read("night/" + name)) << name;
    ++figures;
  }
  EXPECT_EQ(figures, 4);  // SVG and CSV of the two of statics
  EXPECT_FALSE(std::filesystem::exists(in_folder("again/results.h5")));
  // And into its own folder.
  ASSERT_EQ(ddem({"report", path("moved")}).exit_code, 0);
  EXPECT_EQ(read("moved/report.html"), read("night/report.html"));
}

TEST_F(ReportCommand, RefusesWhatIsNoResult) {
  expect_report_refused("no such file");
  std::filesystem::create_directory(in_folder("night"));
  write("night/report.html", "the report of yesterday");
  expect_report_refused("no such file");
  write("night/results.h5", rubbish(5000));
  expect_report_refused("");
}

TEST_F(ReportCommand, RefusesOldAndDamagedResults) {
  std::filesystem::create_directory(in_folder("night"));
  write("night/report.html", "the report of yesterday");
  const auto results = [&](const auto& fill) {
    Hdf5File file = Hdf5File::create(in_folder("night/results.h5"));
    {
      Hdf5Group root = file.root();
      fill(root);
    }
    file.close();
  };
  const auto stored = [&](std::int64_t version, const std::string& structure) {
    results([&](Hdf5Group& root) {
      Hdf5Group report = root.create_group("report");
      report.set_attribute("schema_version", version);
      report.write("structure", std::vector<std::string>{structure});
      report.create_group("arrays");
    });
  };
  results([](Hdf5Group&) {});
  expect_report_refused("older ddem");
  stored(999, "{}");
  expect_report_refused("999");
  stored(1, R"({"title": "x", "sections")");
  expect_report_refused("damaged");
  stored(
      1,
      R"({"sections": [{"figures": [{"id": "f", "panels": [{"type": "plot", "series": [{"x": "0000"}]}]}]}]})");
  expect_report_refused("0000");
  stored(
      1,
      R"({"sections": [{"figures": [{"id": "f", "panels": [{"type": "plot", "x": {"limits": {"lower": 1, "upper": 0}}}]}]}]})");
  expect_report_refused("limits");
}

/// Columns that are empty, missing or of unequal lengths: a figure that cannot be drawn is named; one without points is drawn.
TEST_F(ReportCommand, FiguresWithEmptyColumns) {
  const auto stored = [&](const std::string& panel) {
    std::filesystem::remove_all(in_folder("night"));
    std::filesystem::create_directory(in_folder("night"));
    write("night/report.html", "the report of yesterday");
    Hdf5File file = Hdf5File::create(in_folder("night/results.h5"));
    {
      Hdf5Group report = file.root().create_group("report");
      report.set_attribute("schema_version", std::int64_t{1});
      report.write("structure", std::vector<std::string>{R"({"title": "t", "sections": [{"heading": "h", "figures": [{"id": "fig", "panels": [)" + panel + "]}]}]}"});
      Hdf5Group arrays = report.create_group("arrays");
      arrays.write("0", std::vector<double>{1.0, 2.0, 3.0});
      arrays.write("1", std::vector<double>{});
      arrays.write("2", std::vector<double>{1e-4, 2e-4});
    }
    file.close();
  };
  const std::string limits = R"("limits": {"lower": 0, "upper": 1})";
  for (const auto& [panel, part] : std::vector<std::pair<std::string, std::string>>{
           {R"({"type": "plot", "series": [{"name": "s", "x": "0", "y": "1"}]})", "series 's' has 0 values of y for 3 of x"},
           {R"({"type": "plot", "series": [{"name": "s", "x": "1", "y": "0"}]})", "series 's' has 3 values of y for 0 of x"},
           {R"({"type": "plot", "series": [{"name": "s", "x": "0"}]})", "series 's' has 0 values of y for 3 of x"},
           {R"({"type": "plot", "series": [{"name": "s", "y": "0"}]})", "series 's' has 3 values of y for 0 of x"},
           {R"({"type": "plot", "series": [{"name": "s", "x": "0", "y": "0", "error": "2"}]})", "series 's' has 2 values of error"},
           {R"({"type": "plot", "bands": [{"name": "b", "x": "0", "lower": "1", "upper": "0"}]})", "band 'b' has 0 values of lower"},
           {R"({"type": "plot", "bands": [{"name": "b", "lower": "0", "upper": "0"}]})", "band 'b' has 3 values of lower for 0 of x"},
           {R"({"type": "plot", "map": {"x": "1", "y": "0", "value": "1", "value_axis": {)" + limits + "}}}", "the columns of a heat map"},
           {R"({"type": "plot", "map": {"x": "0", "y": "1", "value": "1", "value_axis": {)" + limits + "}}}", "the rows of a heat map"},
           {R"({"type": "plot", "map": {"x": "0", "y": "0", "value": "1", "value_axis": {)" + limits + "}}}", "has 0 values"},
           {R"({"type": "strip", "title": "discs", "x": "2", "y": "1", "radius": "2"})", "strip 'discs' has 0 values of y for 2 of x"},
           {R"({"type": "strip", "title": "discs", "x": "1", "y": "1", "radius": "2"})", "strip 'discs' has 2 values of radius"},
           {R"({"type": "strip", "title": "discs", "x": "2", "y": "2", "radius": "2", "times": "0", "fields": [{"axis": {"label": "u", )" + limits + "}, \"values\": \"1\"}]}",
            "field 'u' has 0 values for 3 frames of 2 discs"}}) {
    stored(panel);
    SCOPED_TRACE(panel);
    expect_report_refused(part);
    expect_report_refused("figure 'fig'");
  }
  for (const std::string& panel : std::vector<std::string>{
           R"({"type": "plot"})", R"({"type": "plot", "series": [{"name": "s"}]})", R"({"type": "plot", "series": [{"name": "s", "x": "1", "y": "1"}]})",
           R"({"type": "plot", "bands": [{"name": "b", "x": "1", "lower": "1", "upper": "1"}], "series": [{"name": "s", "x": "0", "y": "0"}]})",
           R"({"type": "strip", "title": "no discs"})", R"({"type": "strip", "x": "1", "y": "1", "radius": "1", "times": "0", "fields": [{"axis": {"label": "u", )" + limits + "}, \"values\": \"1\"}]}"}) {
    stored(panel);
    const auto run = ddem({"report", path("night")});
    EXPECT_EQ(run.exit_code, 0) << panel << run.status() << run.standard_error;
    EXPECT_THAT(read("night/figures/fig.svg"), HasSubstr("<svg")) << panel;
  }
}

TEST_F(ReportCommand, RefusesResultsThatAreCutShort) {
  validate();
  std::filesystem::resize_file(in_folder("night/results.h5"),
                               std::filesystem::file_size(in_folder("night/results.h5")) / 2);
  expect_report_refused("");
}

}  // namespace
}  // namespace ddem::harness::test
