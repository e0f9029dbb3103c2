// A file of another version is refused by name, whatever it is of.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/io/atomic_file.h"
#include "harness/io/errors.h"
#include "harness/io/json.h"
#include "harness/nightly/baseline.h"
#include "harness/nightly/plan.h"
#include "harness/nightly/summary.h"
#include "tests/harness/io/scratch.h"

namespace ddem::harness::nightly {
namespace {

/// What reading `document` of a version says; empty where it is read.
template <class Read>
std::string refusal(Json document, const Json& version, const Read& read) {
  document.erase("digest");
  document["schema_version"] = version;
  try {
    read(sealed(std::move(document)));
    return {};
  } catch (const InputError& error) {
    return error.what();
  }
}

template <class Read>
void expect_only_version_1(const Json& document, const Read& read) {
  using testing::HasSubstr;
  EXPECT_EQ(refusal(document, 1, read), "");
  for (const int other : {0, 2, 10})
    EXPECT_THAT(refusal(document, other, read), AllOf(HasSubstr(fmt::format("schema_version = {}, but this ddem reads 1: use the ddem that wrote it", other)), HasSubstr("here")));
  for (const Json& none : {Json(), Json("1"), Json(true), Json::array({1})}) EXPECT_THAT(refusal(document, none, read), HasSubstr("not of ddem")) << none;
}

TEST(SchemaVersions, OfABaseline) {
  expect_only_version_1(Json::parse(baseline_text({{"a | speed", {1.0, 0.1, "m/s"}}})), [](const Json& j) { parse_baseline(to_text(j), "here"); });
}

TEST(SchemaVersions, OfANight) {
  expect_only_version_1(summary_json({"title", 1.0, {}, {}}), [](const Json& j) { parse_summary(unsealed(j, "here"), "here"); });
}

TEST(SchemaVersions, OfAPlan) {
  const Scratch folder;
  const std::filesystem::path campaign = folder / "here";
  std::filesystem::create_directory(campaign);
  write_plan(campaign, {"ddem 1", Json::object(), {{"a", "0"}}, ""});
  const Json document = Json::parse(read_file(campaign / "plan.json"));
  expect_only_version_1(document, [&](const Json& j) {
    write_json(campaign / "plan.json", j);
    read_plan(campaign);
  });
}

}  // namespace
}  // namespace ddem::harness::nightly
