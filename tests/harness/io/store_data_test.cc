// Plain data in HDF5, member by member, and back from JSON.

#include "harness/io/store_data.h"

#include <gtest/gtest.h>

#include "harness/io/data_json.h"
#include "harness/io/hdf5.h"
#include "tests/harness/io/scratch.h"

namespace ddem::harness {
namespace {

enum class Colour { red, green, blue };
DDEM_LAST_ENUMERATOR(Colour, green)

struct Inner {
  double x = 0.0;
  std::optional<double> y;
  std::string name;
  std::vector<double> line;
};
DDEM_MEMBERS(Inner, x, y, name, line)

struct Outer {
  std::string text;
  std::int64_t count = 0;
  bool flag = false;
  double number = 0.0;
  std::optional<double> missing;
  Colour colour = Colour::red;
  std::vector<double> list;
  std::vector<std::string> words;
  std::vector<Inner> table;
  Inner one;
  Eigen::Matrix<double, 2, 3> matrix = Eigen::Matrix<double, 2, 3>::Zero();
};
DDEM_MEMBERS(Outer, text, count, flag, number, missing, colour, list, words, table, one, matrix)

Outer sample() {
  Outer o;
  o.text = "a text";
  o.count = -3;
  o.flag = true;
  o.number = 0.1;
  o.colour = Colour::green;
  o.list = {1.5, 2.5};
  o.words = {"one", "two"};
  o.table = {{1.0, 10.0, "first", {1.0, 2.0, 3.0}}, {2.0, std::nullopt, "second", {4.0, 5.0, 6.0}}};
  o.one.x = 7.0;
  o.matrix << 1.0, 2.0, 3.0, 4.0, 5.0, 6.0;
  return o;
}

TEST(DataJson, ThereAndBackEveryMember) {
  const nlohmann::json j = sample();
  EXPECT_EQ(j.size(), 11u);
  EXPECT_EQ(nlohmann::json(j.get<Outer>()), j);
  nlohmann::json wrong = j;
  for (const int none : {-1, 2, 1000000}) {
    wrong["colour"] = none;
    EXPECT_THROW(wrong.get<Outer>(), std::invalid_argument) << none;
  }
  wrong = j;
  wrong.erase("number");
  EXPECT_THROW(wrong.get<Outer>(), nlohmann::json::exception);
}

TEST(StoreData, MembersAreAttributesDatasetsColumnsAndGroups) {
  const Scratch scratch;
  Hdf5File made = Hdf5File::create(scratch / "data.h5");
  {
    Hdf5Group root = made.root();
    store_data(root, {{"a/b", sample()}, {"unlike", {{{"x", 1}}, {{"y", 2}}}}, {"empty", nlohmann::json::array()}});
  }
  made.close();
  const Hdf5File file = Hdf5File::open(scratch / "data.h5");
  const Hdf5Group g = file.root().group("a:b");
  EXPECT_EQ(g.string_attribute("text"), "a text");
  EXPECT_EQ(g.int_attribute("count"), -3);
  EXPECT_EQ(g.int_attribute("flag"), 1);
  EXPECT_EQ(g.double_attribute("number"), 0.1);
  EXPECT_EQ(g.int_attribute("colour"), 1);
  EXPECT_FALSE(g.has_attribute("missing"));
  EXPECT_EQ(g.string_attribute("missing_status"), "none");
  EXPECT_EQ(g.read_doubles("list").values, (std::vector<double>{1.5, 2.5}));
  EXPECT_EQ(g.read_strings("words"), (std::vector<std::string>{"one", "two"}));
  const Hdf5Group table = g.group("table");
  EXPECT_EQ(table.read_doubles("x").values, (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(table.read_doubles("y").values, (std::vector<double>{10.0, 0.0}));
  EXPECT_EQ(table.read_strings("y_status"), (std::vector<std::string>{"ok", "none"}));
  EXPECT_EQ(table.read_strings("name"), (std::vector<std::string>{"first", "second"}));
  EXPECT_EQ(table.read_doubles("line").shape, (std::vector<std::size_t>{2, 3}));
  EXPECT_EQ(table.read_doubles("line").values, (std::vector<double>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(g.group("one").double_attribute("x"), 7.0);
  EXPECT_FALSE(g.group("one").has_attribute("name"));
  EXPECT_EQ(g.read_doubles("matrix").shape, (std::vector<std::size_t>{2, 3}));
  EXPECT_EQ(g.read_doubles("matrix").values, (std::vector<double>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(file.root().group("unlike").group("0001").int_attribute("y"), 2);
  EXPECT_FALSE(file.root().contains("empty"));
}

}  // namespace
}  // namespace ddem::harness
