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
  EXPECT_GE(figures, 10);  // SVG and CSV of at least five
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

TEST_F(ReportCommand, RefusesResultsThatAreCutShort) {
  validate();
  std::filesystem::resize_file(in_folder("night/results.h5"),
                               std::filesystem::file_size(in_folder("night/results.h5")) / 2);
  expect_report_refused("");
}

}  // namespace
}  // namespace ddem::harness::test
