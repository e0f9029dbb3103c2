#include "harness/io/hdf5.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "harness/io/errors.h"
#include "harness/io/seal.h"
#include "scratch.h"

namespace ddem::harness {
namespace {

TEST(Hdf5, ReadsBackWhatWasWritten) {
  const Scratch scratch;
  std::vector<double> cube(2 * 3 * 4);
  std::iota(cube.begin(), cube.end(), 0.1);
  {
    Hdf5File file = Hdf5File::create(scratch / "r.h5");
    Hdf5Group root = file.root();
    root.set_attribute("version", "0.2.0 \xc2\xb5");
    EXPECT_THROW(root.set_attribute("version", "0.1.0"), MachineError);
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
    file.close();
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
    file.close();
  }
  const std::string whole = content_of(scratch / "whole.h5");
  for (const std::size_t size : {std::size_t{0}, std::size_t{100}, whole.size() / 2, whole.size() - 1}) {
    put(scratch / "cut.h5", whole.substr(0, size));
    EXPECT_THROW(Hdf5File::open(scratch / "cut.h5").root().read_doubles("u"), InputError) << size;
  }
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

/// No byte is read that was not written.
TEST(Hdf5, EveryByteCounts) {
  const Scratch scratch;
  {
    Hdf5File file = Hdf5File::create(scratch / "whole.h5");
    file.root().set_attribute("unit", "m");
    file.root().write("u", std::vector<double>(10, 1.5));
    file.close();
  }
  const std::string whole = content_of(scratch / "whole.h5");
  for (std::size_t at = 0; at < whole.size(); at += at < 600 ? 1 : 13) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ (1 << at % 8));
    put(scratch / "changed.h5", changed);
    EXPECT_THROW(Hdf5File::open(scratch / "changed.h5"), InputError) << at;
  }
  put(scratch / "longer.h5", whole + '\n');
  EXPECT_THROW(Hdf5File::open(scratch / "longer.h5"), InputError);
  std::filesystem::create_symlink(scratch / "whole.h5", scratch / "link.h5");
  EXPECT_EQ(Hdf5File::open(scratch / "link.h5").root().string_attribute("unit"), "m");
}

/// A file that was made up, with a digest that holds.
TEST(Hdf5, ReadsNothingThatIsElsewhereAndNothingThatIsNotThere) {
  const Scratch scratch;
  const auto made_up = [&](const auto& fill) {
    const hid_t id = H5Fcreate((scratch / "f.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    fill(id);
    H5Fclose(id);
    const std::string content = content_of(scratch / "f.h5");
    put(scratch / "f.h5", content + seal_of(content));
    return message_of<InputError>([&] { Hdf5File::open(scratch / "f.h5").root().read_doubles("u"); });
  };
  put(scratch / "secret", std::string(80, 's'));
  const hsize_t ten = 10, many = 1'000'000'000;
  const auto dataset = [](hid_t file, hsize_t length, hid_t properties) {
    const hid_t space = H5Screate_simple(1, &length, nullptr);
    H5Dclose(H5Dcreate2(file, "u", H5T_IEEE_F64LE, space, H5P_DEFAULT, properties, H5P_DEFAULT));
    H5Sclose(space);
  };
  EXPECT_NE(made_up([&](hid_t file) { H5Lcreate_external("other.h5", "/u", file, "u", H5P_DEFAULT, H5P_DEFAULT); }).find("a link"), std::string::npos);
  EXPECT_NE(made_up([&](hid_t file) { H5Lcreate_soft("/v", file, "u", H5P_DEFAULT, H5P_DEFAULT); }).find("a link"), std::string::npos);
  const std::string elsewhere = made_up([&](hid_t file) {
    const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_external(properties, (scratch / "secret").c_str(), 0, 80);
    dataset(file, ten, properties);
    H5Pclose(properties);
  });
  EXPECT_NE(elsewhere.find("other files"), std::string::npos) << elsewhere;
  const std::string large = made_up([&](hid_t file) { dataset(file, many, H5P_DEFAULT); });
  EXPECT_NE(large.find("1000000000 elements"), std::string::npos) << large;
}

}  // namespace
}  // namespace ddem::harness
