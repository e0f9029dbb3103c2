// FILE.xdmf beside FILE.h5: what it names is in the file, and is what /fields has; one that cannot be named
// is refused at once.

#include <pugixml.hpp>

#include "harness/io/hdf5.h"
#include "tests/harness/cli/program.h"

namespace ddem::harness::test {
namespace {

using testing::HasSubstr;

class Xdmf : public Cli {
 protected:
  void run(const std::vector<std::string>& more) const {
    write("scene.toml", small_scene());
    std::vector<std::string> arguments = {"run", path("scene.toml"), "-o", path("new.h5")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto result = ddem(arguments);
    ASSERT_EQ(result.exit_code, 0) << result.standard_error;
  }
};

TEST_F(Xdmf, EveryItemIsInTheFileWithItsShape) {
  run({"--snapshots", "3"});
  pugi::xml_document xdmf;
  ASSERT_TRUE(xdmf.load_string(read("new.xdmf").c_str()));
  EXPECT_EQ(xdmf.select_nodes("//Grid[@CollectionType='Temporal']/Grid/Time").size(), 3u);
  const Hdf5File file = Hdf5File::open(in_folder("new.h5"));
  const auto items = xdmf.select_nodes("//DataItem[@NumberType='Float']");
  // Radius, position, displacement, velocity, rotation and stress; rigid discs have no strain.
  EXPECT_EQ(items.size(), 3u * (5 + 3));
  for (const auto& node : items) {
    const std::string place = node.node().text().get();
    ASSERT_THAT(place, testing::StartsWith("new.h5:/"));
    const auto array = file.root().read_doubles(place.substr(std::string("new.h5:/").size()));
    std::string shape;
    for (const std::size_t extent : array.shape) shape += (shape.empty() ? "" : " ") + std::to_string(extent);
    EXPECT_EQ(node.node().attribute("Dimensions").value(), shape) << place;
  }
}

TEST_F(Xdmf, PointsShowTheFields) {
  run({"--snapshots", "3"});
  const Hdf5File file = Hdf5File::open(in_folder("new.h5"));
  const Hdf5Group fields = file.root().group("fields"), frame = file.root().group("points").group("0001");
  const auto u = frame.read_doubles("displacement"), s = frame.read_doubles("stress_xy");
  const auto ux = fields.read_doubles("displacement_x").values,
             uy = fields.read_doubles("displacement_y").values, sxy = fields.read_doubles("stress_xy").values;
  ASSERT_EQ(u.shape, (std::vector<std::size_t>{240, 3}));
  ASSERT_EQ(s.shape, std::vector<std::size_t>{240});
  for (std::size_t i = 0; i < 240; ++i) {
    EXPECT_EQ(u.values[3 * i], ux[240 + i]);
    EXPECT_EQ(u.values[3 * i + 1], uy[240 + i]);
    EXPECT_EQ(u.values[3 * i + 2], 0.0);
    EXPECT_EQ(s.values[i], sxy[240 + i]);
  }
}

TEST_F(Xdmf, IsWrittenWhereSnapshotsAreAskedFor) {
  run({});
  EXPECT_FALSE(std::filesystem::exists(in_folder("new.xdmf")));
}

TEST_F(Xdmf, RefusesNamesThatItCannotHold) {
  write("scene.toml", small_scene());
  const auto before = contents();
  const auto run = ddem({"run", path("scene.toml"), "-o", path("a:b.h5"), "--snapshots", "2"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.standard_error, HasSubstr("colon"));
  expect_contents(before);
}

TEST_F(Xdmf, OverwritesNoOtherOutput) {
  write("scene.toml", small_scene());
  const auto run =
      ddem({"run", path("scene.toml"), "-o", path("a.h5"), "--signals", path("a.xdmf"), "--snapshots", "2"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.standard_error, HasSubstr("a.xdmf"));
}

}  // namespace
}  // namespace ddem::harness::test
