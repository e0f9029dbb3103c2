#include "harness/io/hdf5.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "harness/io/atomic_file.h"
#include "harness/io/errors.h"
#include "scratch.h"

namespace ddem::harness {
namespace {

TEST(Hdf5, ReadsBackWhatWasWritten) {
  const Scratch scratch;
  std::vector<double> cube(2 * 3 * 4);
  std::iota(cube.begin(), cube.end(), 0.1);
  {
    AtomicFile target(scratch / "r.h5");
    Hdf5File file = Hdf5File::create(target.temporary_path());
    Hdf5Group root = file.root();
    root.set_attribute("version", "0.1.0 \xc2\xb5");
    root.set_attribute("version", "0.2.0 \xc2\xb5");  // replaced
    root.set_attribute("scene", std::string(200'000, 's'));
    root.set_attribute("seed", 42);
    root.set_attribute("k_n", 1e10);
    Hdf5Group signals = root.create_group("signals");
    signals.write("cube", cube, {2, 3, 4}).set_attribute("unit", "m");
    signals.write("bonds", std::vector<int>{1, -2, 3, 4}, {2, 2});
    signals.write("names", std::vector<std::string>{"p0_ux", "", "\xc3\xa4"});
    signals.write("empty", std::vector<double>{});
    EXPECT_FALSE(std::filesystem::exists(scratch / "r.h5"));
    file.close();
    target.commit();
  }
  const Hdf5File file = Hdf5File::open(scratch / "r.h5");
  const Hdf5Group root = file.root();
  EXPECT_EQ(root.string_attribute("version"), "0.2.0 \xc2\xb5");
  EXPECT_EQ(root.string_attribute("scene").size(), 200'000U);
  EXPECT_EQ(root.int_attribute("seed"), 42);
  EXPECT_EQ(root.double_attribute("k_n"), 1e10);
  EXPECT_EQ(root.names(), std::vector<std::string>{"signals"});
  const Hdf5Group signals = root.group("signals");
  const Hdf5Array<double> back = signals.read_doubles("cube");
  EXPECT_EQ(back.shape, (std::vector<std::size_t>{2, 3, 4}));
  EXPECT_EQ(back.values, cube);
  EXPECT_EQ(signals.dataset("cube").string_attribute("unit"), "m");
  EXPECT_FALSE(signals.dataset("cube").has_attribute("status"));
  EXPECT_EQ(signals.read_ints("bonds").values, (std::vector<int>{1, -2, 3, 4}));
  EXPECT_EQ(signals.read_strings("names"), (std::vector<std::string>{"p0_ux", "", "\xc3\xa4"}));
  EXPECT_TRUE(signals.read_doubles("empty").values.empty());
  EXPECT_TRUE(signals.contains("cube"));
  EXPECT_FALSE(signals.contains("cone"));
}

TEST(Hdf5, LargeArraysAreCompressedAndExact) {
  const Scratch scratch;
  std::vector<double> rows(3 * 200'000);
  for (std::size_t n = 0; n < rows.size(); ++n) rows[n] = std::sin(1e-3 * static_cast<double>(n / 1000));
  const std::vector<std::size_t> shapes[] = {{rows.size()}, {3, 200'000}, {200'000, 3}, {2, 3, 100'000}};
  for (const std::vector<std::size_t>& shape : shapes) {
    Hdf5File file = Hdf5File::create(scratch / "big.h5");
    file.root().write("rows", rows, shape);
    file.close();
    EXPECT_LT(std::filesystem::file_size(scratch / "big.h5"), rows.size() * sizeof(double) / 4);
    const Hdf5Array<double> back = Hdf5File::open(scratch / "big.h5").root().read_doubles("rows");
    EXPECT_EQ(back.shape, shape);
    EXPECT_EQ(back.values, rows);
  }
}

TEST(Hdf5, NonFiniteNumbersHaveAStatusBesideThem) {
  const Scratch scratch;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Hdf5File file = Hdf5File::create(scratch / "n.h5");
  Hdf5Group root = file.root();
  EXPECT_THROW(root.set_attribute("speed", nan), std::invalid_argument);
  const Hdf5Dataset diverged = root.write("u", std::vector<double>{0.0, 1.0, nan, nan});
  EXPECT_EQ(diverged.string_attribute("status"), "holds numbers that are not finite, first at flat index 2");
}

TEST(Hdf5, WrongUse) {
  const Scratch scratch;
  Hdf5File file = Hdf5File::create(scratch / "w.h5");
  Hdf5Group root = file.root();
  const std::vector<double> four(4, 1.0);
  EXPECT_THROW(root.write("u", four, {3}), std::invalid_argument);
  EXPECT_THROW(root.write("u", four, {1, 1, 2, 2}), std::invalid_argument);
  EXPECT_THROW(root.set_attribute("text", std::string("a\0b", 3)), std::invalid_argument);
  root.write("u", four);
  const std::string twice = message_of<MachineError>([&] { root.write("u", four); });
  EXPECT_NE(twice.find("w.h5:/u"), std::string::npos) << twice;
  EXPECT_NE(twice.find("exist"), std::string::npos) << twice;  // HDF5's own reason
  file.close();
  EXPECT_THROW(file.root(), InputError);
  EXPECT_NO_THROW(file.close());
}

TEST(Hdf5, ReadingFailuresNameThePlaceAndPrintNothing) {
  const Scratch scratch;
  put(scratch / "text.h5", "time,ux\n");
  {
    Hdf5File file = Hdf5File::create(scratch / "good.h5");
    file.root().write("names", std::vector<std::string>{"a"});
    file.root().set_attribute("seed", 1);
  }
  testing::internal::CaptureStderr();
  EXPECT_THROW(Hdf5File::open(scratch / "missing.h5"), InputError);
  EXPECT_THROW(Hdf5File::open(scratch / "text.h5"), InputError);
  EXPECT_THROW(Hdf5File::create(scratch / "no/such.h5"), MachineError);
  const Hdf5File file = Hdf5File::open(scratch / "good.h5");
  const Hdf5Group root = file.root();
  const std::string missing = message_of<InputError>([&] { root.read_doubles("u"); });
  EXPECT_NE(missing.find("good.h5:/u: no such dataset"), std::string::npos) << missing;
  EXPECT_THROW(root.read_doubles("names"), InputError);
  EXPECT_THROW(root.read_ints("names"), InputError);
  EXPECT_THROW(root.group("signals"), InputError);
  EXPECT_THROW(root.string_attribute("seed"), InputError);
  EXPECT_THROW(root.int_attribute("weed"), InputError);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Hdf5, TruncatedFilesAreRefused) {
  const Scratch scratch;
  {
    Hdf5File file = Hdf5File::create(scratch / "whole.h5");
    file.root().write("u", std::vector<double>(1000, 1.5));
  }
  const std::string whole = content_of(scratch / "whole.h5");
  for (const std::size_t size : {std::size_t{0}, std::size_t{100}, whole.size() / 2, whole.size() - 1}) {
    put(scratch / "cut.h5", whole.substr(0, size));
    EXPECT_THROW(Hdf5File::open(scratch / "cut.h5").root().read_doubles("u"), InputError) << size;
  }
}

/// Writes 800 kB where files may grow to `limit` bytes, and leaves with the exit code of what happens: the
/// way of the program, through std::exit and its handlers.
[[noreturn]] void write_and_exit(const std::filesystem::path& path, rlim_t limit) {
  ::signal(SIGXFSZ, SIG_IGN);  // write() then fails with EFBIG, as it does with ENOSPC
  const rlimit size{limit, limit};
  ::setrlimit(RLIMIT_FSIZE, &size);
  try {
    AtomicFile target(path);
    Hdf5File file = Hdf5File::create(target.temporary_path());
    std::vector<double> incompressible(100'000);
    for (std::size_t n = 0; n < incompressible.size(); ++n)
      incompressible[n] = std::sin(1e6 * static_cast<double>(n));
    file.root().write("u", incompressible);
    file.close();
    target.commit();
  } catch (const std::exception& error) {
    const std::string text = error.what();
    [[maybe_unused]] const auto shown = ::write(2, text.data(), text.size());
    std::exit(static_cast<int>(exit_code_of(error)));
  }
  std::exit(0);
}

TEST(Hdf5, ViewsShowRowsOfTheSameFileWhateverItIsCalled) {
  const Scratch scratch;
  std::vector<double> x(2 * 1000), y(2 * 1000);
  std::iota(x.begin(), x.end(), 0.5);
  std::iota(y.begin(), y.end(), -7.5);
  {
    Hdf5File file = Hdf5File::create(scratch / "before.h5");
    Hdf5Group fields = file.root().create_group("fields"), views = file.root().create_group("views");
    fields.write("x", x, {2, 1000});
    fields.write("y", y, {2, 1000});
    const std::vector<Hdf5Row> both = {{"/fields/x", 1}, {"/fields/y", 0}}, beyond = {{"/fields/x", 2}}, missing = {{"/fields/z", 0}};
    views.write_view("vector", both, 3);
    views.write_view("column", std::span(both).first(1), 1);
    EXPECT_THROW(views.write_view("beyond", beyond, 1), std::invalid_argument);
    EXPECT_THROW(views.write_view("narrow", both, 1), std::invalid_argument);
    EXPECT_THROW(views.write_view("missing", missing, 1), MachineError);
    file.close();
  }
  const std::uintmax_t size = std::filesystem::file_size(scratch / "before.h5");
  EXPECT_LT(size, 4u * 1000 * 8 + 16'384);  // the fields, and no copy of them
  std::filesystem::rename(scratch / "before.h5", scratch / "after.h5");
  const Hdf5File file = Hdf5File::open(scratch / "after.h5");
  const auto vector = file.root().group("views").read_doubles("vector");
  ASSERT_EQ(vector.shape, (std::vector<std::size_t>{1000, 3}));
  for (std::size_t i = 0; i < 1000; ++i) {
    EXPECT_EQ(vector.values[3 * i], x[1000 + i]);
    EXPECT_EQ(vector.values[3 * i + 1], y[i]);
    EXPECT_EQ(vector.values[3 * i + 2], 0.0);
  }
  EXPECT_EQ(file.root().group("views").read_doubles("column").values, std::vector<double>(x.begin() + 1000, x.end()));
}

TEST(Hdf5, FullDiskIsExitCodeFourAndNoCrash) {
  // HDF5's own exit handler crashes here (signal 11) if it is left to run.
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // a fresh process: HDF5 must not be in use before
  const Scratch scratch;
  EXPECT_EXIT(write_and_exit(scratch / "full.h5", 20'000), testing::ExitedWithCode(4), "cannot");
  EXPECT_EQ(scratch.entries(), 0);  // neither a target nor a temporary file
  EXPECT_EXIT(write_and_exit(scratch / "enough.h5", 2'000'000), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace ddem::harness
