// `ddem fem --snapshots`: fields and FILE.xdmf beside FILE.h5, which name what is there; and what is refused.

#include <pugixml.hpp>

#include "harness/io/hdf5.h"
#include "tests/harness/cli/program.h"

namespace ddem::harness::test {
namespace {

using testing::HasSubstr;

std::string continuum_scene(const std::string& integrator) {
  return R"([assembly]
length = "4 mm"
width = "1 mm"
[boundary]
top_bottom = "periodic"
[initial]
wave = "shear"
shape = "gaussian"
amplitude = "1 um"
width = "0.3 mm"
center = "1.5 mm"
[continuum]
young_modulus = "10 GPa"
poisson_ratio = 0.25
density = "1700 kg/m3"
degree = 2
elements = [8, 2]
[time]
step_fraction = 0.5
end = "1 us"
)" + integrator + R"(
[probes]
points = [["2 mm", "0.5 mm"]]
)";
}

class FemFields : public Cli {
 protected:
  void expect_refusal(const std::vector<std::string>& more, const std::string& part) const {
    const auto before = contents();
    std::vector<std::string> arguments = {"fem", path("scene.toml")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto run = ddem(arguments);
    EXPECT_EQ(run.exit_code, 2) << run.status();
    EXPECT_EQ(run.standard_output, "");
    EXPECT_THAT(run.standard_error, HasSubstr(part));
    expect_contents(before);
  }
};

// The default of the continuum is exact in time at its receivers; fields are not, and no signal changes unasked.
TEST_F(FemFields, AreRefusedWhereTheIntegratorIsExact) {
  for (const char* integrator : {"", "integrator = \"exact\""}) {
    write("scene.toml", continuum_scene(integrator));
    expect_refusal({"-o", path("new.h5"), "--snapshots", "2"}, "write integrator = \"verlet\" in [time]");
  }
}

TEST_F(FemFields, NeedAFileThatXdmfCanName) {
  write("scene.toml", continuum_scene("integrator = \"verlet\""));
  expect_refusal({"--snapshots", "2"}, "--output");
  expect_refusal({"-o", path("a:b.h5"), "--snapshots", "2"}, "colon");
  expect_refusal({"-o", path("a.h5"), "--signals", path("a.xdmf"), "--snapshots", "2"}, "a.xdmf");
  expect_refusal({"-o", path("a.h5"), "--snapshots", "0"}, "--snapshots");
}

#ifdef DDEM_HAS_FEM
TEST_F(FemFields, AreInTheFileAsXdmfSays) {
  write("scene.toml", continuum_scene("integrator = \"verlet\""));
  const auto run = ddem({"fem", path("scene.toml"), "-o", path("new.h5"), "--snapshots", "3"});
  ASSERT_EQ(run.exit_code, 0) << run.standard_error;
  pugi::xml_document xdmf;
  ASSERT_TRUE(xdmf.load_string(read("new.xdmf").c_str()));
  const Hdf5File file = Hdf5File::open(in_folder("new.h5"));
  const auto times = file.root().group("fields").read_doubles("time").values;
  const auto frames = xdmf.select_nodes("//Grid[@CollectionType='Temporal']/Grid/Time");
  ASSERT_EQ(times.size(), 3u);
  ASSERT_EQ(frames.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(frames[k].node().attribute("Value").as_double(), times[k]);
  const auto items = xdmf.select_nodes("//DataItem");
  EXPECT_EQ(items.size(), 3u * 10);  // cells, position, displacement, velocity, three of stress, three of strain
  for (const auto& node : items) {
    const std::string place = node.node().text().get();
    ASSERT_THAT(place, testing::StartsWith("new.h5:/"));
    std::string shape;
    const std::string dataset = place.substr(std::string("new.h5:/").size());
    const bool cells = dataset.find("quadrilaterals") != std::string::npos;
    for (const std::size_t extent : cells ? file.root().read_ints(dataset).shape : file.root().read_doubles(dataset).shape) {
      shape += (shape.empty() ? "" : " ") + std::to_string(extent);
    }
    EXPECT_EQ(node.node().attribute("Dimensions").value(), shape) << place;
  }
  // 17 x 5 points: the nodes of periodic edges stand at both.
  const auto uy = file.root().group("fields").read_doubles("displacement_y");
  EXPECT_EQ(uy.shape, (std::vector<std::size_t>{3, 17 * 5}));
  const auto shown = file.root().group("points").group("0002").read_doubles("displacement").values;
  for (std::size_t k = 0; k < 17 * 5; ++k) EXPECT_EQ(shown[3 * k + 1], uy.values[2 * 17 * 5 + k]);
}

TEST_F(FemFields, AreLeftOutWhereNobodyAsks) {
  write("scene.toml", continuum_scene("integrator = \"verlet\""));
  ASSERT_EQ(ddem({"fem", path("scene.toml"), "-o", path("new.h5")}).exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(in_folder("new.xdmf")));
  EXPECT_FALSE(Hdf5File::open(in_folder("new.h5")).root().contains("fields"));
}
#endif

}  // namespace
}  // namespace ddem::harness::test
