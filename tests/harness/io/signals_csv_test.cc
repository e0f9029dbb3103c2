#include "harness/io/signals_csv.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "harness/io/errors.h"
#include "scratch.h"

namespace ddem::harness {
namespace {

TEST(SignalsCsv, HeaderAndShortestNumbers) {
  const Scratch scratch;
  const SignalTable table{
      {0.0, 1e-7, 2e-7}, {"disc12_ux", "disc12_theta"}, {{0.1, 1.0 / 3.0, -5e-324}, {1.0, 0.0, 2e300}}};
  write_signals_csv(scratch / "s.csv", table);
  EXPECT_EQ(content_of(scratch / "s.csv"),
            "time,disc12_ux,disc12_theta\n0,0.1,1\n1e-07,0.3333333333333333,0\n2e-07,-5e-324,2e+300\n");
  const SignalTable back = read_signals_csv(scratch / "s.csv");
  EXPECT_EQ(back.time, table.time);
  EXPECT_EQ(back.names, table.names);
  EXPECT_EQ(back.channels, table.channels);
}

TEST(SignalsCsv, NothingIsWrittenOfWhatIsWrong) {
  const Scratch scratch;
  const double not_a_number = std::numeric_limits<double>::quiet_NaN(),
               infinite = std::numeric_limits<double>::infinity();
  const auto write = [&](const SignalTable& table) { write_signals_csv(scratch / "s.csv", table); };
  EXPECT_THROW(write({{0.0, 1.0}, {"ux"}, {{1.0, not_a_number}}}), std::invalid_argument);
  EXPECT_THROW(write({{0.0, infinite}, {"ux"}, {{1.0, 1.0}}}), std::invalid_argument);
  EXPECT_THROW(write({{0.0, 1.0}, {"ux"}, {{1.0}}}), std::invalid_argument);
  EXPECT_THROW(write({{0.0, 1.0}, {"ux", "uy"}, {{1.0, 1.0}}}), std::invalid_argument);
  EXPECT_THROW(write({{0.0}, {"u,x"}, {{1.0}}}), std::invalid_argument);
  EXPECT_EQ(scratch.entries(), 0);
}

TEST(SignalsCsv, ReadsWhatOthersWrite) {
  const Scratch scratch;
  put(scratch / "dos.csv", "time,p0_ux\r\n0,1\r\n1.5E-3,-2.25e0");
  const SignalTable table = read_signals_csv(scratch / "dos.csv");
  EXPECT_EQ(table.time, (std::vector<double>{0.0, 1.5e-3}));
  EXPECT_EQ(table.channels, (std::vector<std::vector<double>>{{1.0, -2.25}}));
  put(scratch / "none.csv", "time,p0_ux\n");
  EXPECT_TRUE(read_signals_csv(scratch / "none.csv").time.empty());
}

TEST(SignalsCsv, ErrorsNameFileLineAndColumn) {
  const Scratch scratch;
  struct Case {
    std::string content, expected;
  };
  for (const Case& c : {
           Case{"", "b.csv:1: the first column must be 'time'"},
           Case{"x,y\n", "b.csv:1: the first column must be 'time'"},
           Case{"time,ux,ux\n", "b.csv:1: column 3"},
           Case{"time,\n", "b.csv:1: column 2"},
           Case{"time,ux\n0,1\n1\n", "b.csv:3: 1 columns"},
           Case{"time,ux\n0,1,2\n", "b.csv:2: 3 columns"},
           Case{"time,ux\n0,1\n\n2,1\n", "b.csv:3: 1 columns"},
           Case{"time,ux\n0,nan\n", "b.csv:2: ux: 'nan' is not a finite number"},
           Case{"time,ux\n0,inf\n", "b.csv:2: ux: 'inf' is not a finite number"},
           Case{"time,ux\n0,1e999\n", "b.csv:2: ux: '1e999' is not a finite number"},
           Case{"time,ux\n0,1.5x\n", "b.csv:2: ux: '1.5x' is not"},
           Case{"time,ux\n0,\n", "b.csv:2: ux: '' is not"},
           Case{"time,ux\n0,1\n0,2\n", "b.csv:3: time 0 does not increase"},
           Case{std::string("time,ux\n0,\x89PNG\0\xff", 16), "b.csv:2: ux: '.PNG..' is not"},
       }) {
    put(scratch / "b.csv", c.content);
    const std::string reason = message_of<InputError>([&] { read_signals_csv(scratch / "b.csv"); });
    EXPECT_NE(reason.find(c.expected), std::string::npos) << reason;
  }
}

}  // namespace
}  // namespace ddem::harness
