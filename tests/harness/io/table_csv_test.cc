// Tables as oscilloscopes and spreadsheets write them.

#include "harness/io/table_csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>

#include "harness/io/errors.h"
#include "harness/io/temporary_folder.h"

namespace ddem::harness {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class TableCsv : public testing::Test {
 protected:
  CsvTable table(const std::string& text) const {
    const auto path = folder_.path() / "t.csv";
    std::ofstream(path, std::ios::binary) << text;
    return CsvTable(path);
  }
  std::string problem(const std::string& text) const {
    try {
      const CsvTable t = table(text);
      std::vector<std::size_t> all;
      for (std::size_t c = 0; c < t.names().size(); ++c) all.push_back(c);
      (void)t.numbers(all);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }

 private:
  TemporaryFolder folder_{"ddem-table-test"};
};

TEST_F(TableCsv, ReadsWhatOthersWrite) {
  for (const char* text : {"t,a,b\n1,2,-3.5e-1\n2,+4,5\n", "# scope\n\n t , \"a\", b\r\n1, 2,-3.5e-1\r\n# pause\r\n2,+4 ,5\r\n",
                           "\xEF\xBB\xBFt;a;b\n1;2;-0,35\n2;4,0;5", "t\ta\tb\n1\t2\t-.35\n2\t4\t5\n"}) {
    const CsvTable t = table(text);
    EXPECT_THAT(t.names(), ElementsAre("t", "a", "b")) << text;
    ASSERT_EQ(t.rows(), 2u) << text;
    const auto columns = t.numbers(std::array<std::size_t, 2>{2, 1});
    EXPECT_THAT(columns[0], ElementsAre(-0.35, 5.0)) << text;
    EXPECT_THAT(columns[1], ElementsAre(2.0, 4.0)) << text;
  }
  EXPECT_EQ(table("# one\nt,a\n\n1,2\n").line(0), 4);
}

TEST_F(TableCsv, ReadsOnlyTheColumnsThatAreAskedFor) {
  const CsvTable t = table("t,name,a\n1,x,2\n");
  EXPECT_THAT(t.numbers(std::array<std::size_t, 1>{2})[0], ElementsAre(2.0));
}

TEST_F(TableCsv, SaysWhereSomethingIsWrong) {
  EXPECT_THAT(problem("t,a\n1,2\n2,x\n"), HasSubstr("t.csv:3: a: 'x' is not a finite number"));
  EXPECT_THAT(problem("t,a\n1,nan\n"), HasSubstr("t.csv:2: a: 'nan'"));
  EXPECT_THAT(problem("t,a\n1,\n"), HasSubstr("a: ''"));
  EXPECT_THAT(problem("t,a\ns,V\n1,2\n"), HasSubstr("is it a line of units? Put a # before it"));
  EXPECT_THAT(problem("t,a\n1,2,3\n"), HasSubstr("t.csv:2: 3 fields, but there are 2 names"));
  EXPECT_THAT(problem("1,2\n3,4\n"), HasSubstr("numbers where the names of the columns belong"));
  EXPECT_THAT(problem("t,a,a\n1,2,3\n"), HasSubstr("column 3 has an empty or repeated name, 'a'"));
  EXPECT_THAT(problem("t,,a\n1,2,3\n"), HasSubstr("column 2"));
  EXPECT_THAT(problem("t,a\n"), HasSubstr("no rows"));
  EXPECT_THAT(problem(""), HasSubstr("empty"));
  EXPECT_THAT(problem(std::string(1000, '\x01')), HasSubstr("no rows"));
}

}  // namespace
}  // namespace ddem::harness
