// Outputs are what they are on the disk, not what they are called. The commands' side: tests/harness/cli/claims_test.cc.

#include "harness/io/claim_outputs.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "harness/io/errors.h"
#include "tests/harness/io/scratch.h"

namespace ddem::harness {
namespace {

namespace fs = std::filesystem;
using namespace std::string_view_literals;

constexpr OutputKind kCsv = OutputKind::signals_csv;

void expect_claimed(const std::vector<Output>& outputs, const std::vector<fs::path>& inputs = {}, bool force = false) {
  EXPECT_NO_THROW(claim_outputs(outputs, inputs, force)) << outputs.front().path;
}

void expect_refused(const std::vector<Output>& outputs, const std::string& why, const std::vector<fs::path>& inputs = {},
                    bool force = false) {
  const std::string message = message_of<InputError>([&] { claim_outputs(outputs, inputs, force); });
  EXPECT_NE(message.find(why), std::string::npos) << message;
}

TEST(ClaimOutputs, NoOutputIsAnInputByAnyName) {
  const Scratch s;
  put(s / "in.csv", "time,disc1_ux\n");
  fs::create_directory(s / "folder");
  fs::create_symlink("in.csv", s / "soft.csv");
  fs::create_symlink("soft.csv", s / "soft_soft.csv");
  fs::create_directory_symlink(".", s / "around");
  fs::create_hard_link(s / "in.csv", s / "hard.csv");
  for (const char* name : {"in.csv", "./in.csv", "folder/../in.csv", "soft.csv", "soft_soft.csv", "around/in.csv", "hard.csv"}) {
    for (const bool force : {false, true}) {
      expect_refused({{s / name, kCsv}}, "would overwrite", {s / "in.csv"}, force);
      expect_refused({{s / "in.csv", kCsv}}, "would overwrite", {s / name}, force);
    }
  }
  expect_claimed({{s / "folder/in.csv", kCsv}}, {s / "in.csv"});
  EXPECT_EQ(s.entries(), 6);
  EXPECT_EQ(content_of(s / "in.csv"), "time,disc1_ux\n");
}

TEST(ClaimOutputs, NoOutputIsAnother) {
  const Scratch s;
  put(s / "there.csv", "");
  fs::create_directory(s / "folder");
  fs::create_directory_symlink(".", s / "around");
  fs::create_symlink("new.csv", s / "dangling.csv");
  fs::create_hard_link(s / "there.csv", s / "hard.csv");
  for (const char* name : {"new.csv", "./new.csv", "folder/../new.csv", "around/new.csv", "dangling.csv"})
    expect_refused({{s / "new.csv", kCsv}, {s / name, OutputKind::run_hdf5}}, "would overwrite");
  expect_refused({{s / "there.csv", kCsv}, {s / "hard.csv", kCsv}}, "would overwrite");
  expect_claimed({{s / "new.csv", kCsv}, {s / "New.csv", kCsv}, {s / "folder/new.csv", kCsv}, {"", kCsv}, {"", kCsv}});
  expect_claimed({{"/dev/null", kCsv}, {"/dev/null", kCsv}});
  EXPECT_FALSE(fs::exists(s / "new.csv"));
}

TEST(ClaimOutputs, AllProblemsAtOnce) {
  const Scratch s;
  fs::create_directory(s / "folder");
  const auto message = message_of<InputError>(
      [&] { claim_outputs({{s / "folder", kCsv}, {s / "none/a.csv", kCsv}, {s / "", kCsv}}, {}, true); });
  for (const char* part : {"is a folder", "does not exist; create it first", "names no file"})
    EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST(ClaimOutputs, DevicesAndPipesTakeText) {
  const Scratch s;
  ASSERT_EQ(::mkfifo((s / "pipe").c_str(), 0666), 0);
  for (const fs::path& p : {s / "pipe", fs::path("/dev/null"), fs::path("/dev/full"), fs::path("/dev/stdout"), fs::path("/dev/fd/1")}) {
    expect_claimed({{p, kCsv}});
    expect_refused({{p, OutputKind::run_hdf5}}, "cannot go to", {}, true);
    expect_refused({{p, OutputKind::xdmf}}, "cannot go to", {}, true);
  }
}

TEST(ClaimOutputs, WhereNothingCanBeWritten) {
  EXPECT_THROW(claim_outputs({{"/sys/a.csv", kCsv}}, {}, false), MachineError);
  const Scratch s;
  fs::create_symlink("loop", s / "loop");
  EXPECT_THROW(claim_outputs({{s / "loop", kCsv}}, {}, false), MachineError);
  expect_refused({{s / std::string(256, 'x'), kCsv}}, "name is longer");
  expect_claimed({{s / std::string(255, 'x'), kCsv}});
  EXPECT_EQ(s.entries(), 1);
}

TEST(ClaimFolder, WhereNoneCanBeMadeAnOptionIsNamed) {
  const std::string message = message_of<MachineError>([] { claim_folder("/proc/ddem-report"); });  // not for root, either
  EXPECT_NE(message.find("/proc/ddem-report: cannot create the folder: "), std::string::npos) << message;
  EXPECT_NE(message.find("-o"), std::string::npos) << message;
}

TEST(ClaimOutputs, OtherUsersInAFolderOfEverybody) {
  if (::geteuid() != 0) GTEST_SKIP() << "needs root";
  const Scratch s;
  fs::permissions(s / "", fs::perms::all);
  fs::create_directory(s / "all");
  put(s / "all/theirs.csv", "");
  fs::create_symlink("new.csv", s / "all/link.csv");
  const auto give = [&](const char* name, uid_t user) { ASSERT_EQ(::lchown((s / name).c_str(), user, user), 0); };
  for (const char* name : {"all", "all/theirs.csv", "all/link.csv"}) give(name, 12345);
  ASSERT_EQ(::chmod((s / "all").c_str(), 01777), 0);
  ASSERT_EQ(::seteuid(65534), 0);
  EXPECT_THROW(claim_outputs({{s / "all/theirs.csv", kCsv}}, {}, true), MachineError);
  expect_claimed({{s / "all/mine.csv", kCsv}});
  ASSERT_EQ(::seteuid(0), 0);
  // The folder's own user may set links in it; a third one may not.
  expect_claimed({{s / "all/link.csv", kCsv}});
  give("all/link.csv", 54321);
  expect_refused({{s / "all/link.csv", kCsv}}, "link of another user", {}, true);
}

struct Sample {
  OutputKind kind;
  std::string ours;
  std::vector<std::string> near_misses;
};

const std::vector<Sample> kSamples = {
    {kCsv, "time,disc12_ux,disc12_uy,disc12_theta\n0,0,0,0\n",
     {"time,temperature\n0,1\n", "time,room_temperature\n", "timer_ux\n", "x,y,radius\n", "time, disc_ux,b\n", "time,disc1_ux,\n"}},
    {OutputKind::packing_csv, "x,y,radius\n1,2,3\n", {"x,y\n", "x,y,radius,mass\n", "time,disc1_ux\n", "# x,y,radius\n"}},
    {OutputKind::xdmf, "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">", {"<?xml version=\"1.0\"?>\n<svg>", "<Xdmf "}},
    {OutputKind::scene, std::string(kWrittenScene) + "[assembly]\n", {"[assembly]\n", "# mine\n" + std::string(kWrittenScene)}},
    {OutputKind::baseline, "{\n\"schema_version\": 1,\n\"metrics\": {\n}\n}\n", {"{\"schema_version\": 1}", "{\n  \"schema_version\": 1,\n"}},
    {OutputKind::curves_csv, "model,coordination,softness,particle_poisson_ratio,stiffness_ratio\n", {"model,coordination\n"}},
    {OutputKind::figure,
     "<?xml version=\"1.0\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 9 9\" width=\"9\" role=\"img\" aria-labelledby=\"a b\">", {"<?xml version=\"1.0\"?><svg ", "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"3\">"}},
    {OutputKind::bench_json, "{\n  \"schema_version\": 1,\n  \"provenance\": {},\n  \"kernels\": []", {"{\n  \"schema_version\": 1,\n  \"cases\": []"}},
    {OutputKind::report, "<!DOCTYPE html>\n<html lang=\"en\">\n<head><link rel=\"icon\" href=\"data:,\">",
     {"<!DOCTYPE html>\n<html lang=\"en\">\n<head>", "<!DOCTYPE html>\n<html>", "<html lang=\"en\">"}},
    {OutputKind::exchange, "id,x,y,radius,mass,inertia,held_x\n", {"x,y,radius\n", "disc,x\n", "{\n  \"schema_version\": 1"}},
    {OutputKind::run_hdf5, std::string("\x89HDF\r\n\x1a\n\0scene\0signals\0instruction set\0"sv),
     {std::string("\x89HDF\r\n\x1a\n\0signals\0"sv), std::string("\x89HDF\r\n\x1a\n\0statics\0scene\0signals\0instruction set\0"sv), std::string("\0scene\0signals\0instruction set\0"sv)}},
};

TEST(ClaimOutputs, ForeignFilesNeedForce) {
  const Scratch s;
  const auto claim = [&](OutputKind kind, const std::string& content, bool allowed) {
    put(s / "a", content);
    if (allowed) return expect_claimed({{s / "a", kind}});
    expect_refused({{s / "a", kind}}, "--force");
    expect_claimed({{s / "a", kind}}, {}, true);
    EXPECT_EQ(content_of(s / "a"), content);
  };
  for (const Sample& sample : kSamples) {
    claim(sample.kind, "", true);
    claim(sample.kind, "\n", false);
    claim(sample.kind, "thesis", false);
    for (const std::string& text : sample.near_misses) claim(sample.kind, text, false);
    for (const Sample& other : kSamples) claim(sample.kind, other.ours, sample.kind == other.kind);
  }
  std::string wide = "time";
  while (wide.size() < 2 * kBeginningBytes) wide += ",disc" + std::to_string(wide.size()) + "_theta";
  claim(kCsv, wide + "\n", true);
}

}  // namespace
}  // namespace ddem::harness
