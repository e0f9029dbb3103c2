#include "harness/io/json.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "harness/io/errors.h"
#include "scratch.h"

namespace ddem::harness {
namespace {

const double nan = std::numeric_limits<double>::quiet_NaN();
const double inf = std::numeric_limits<double>::infinity();

TEST(Json, NumbersOrStatus) {
  EXPECT_EQ(number_or_status(1.5, "no pick"), Json(1.5));
  for (const double bad : {nan, inf, -inf}) {
    const Json status = number_or_status(bad, "no pick");
    EXPECT_TRUE(status.is_object());
    EXPECT_EQ(status.at("status"), "not a number: no pick");
  }
  EXPECT_EQ(numbers_or_status({1.0, nan}, "diverged").dump(), R"([1.0,{"status":"not a number: diverged"}])");
}

TEST(Json, NonFiniteNumbersAreNeverWritten) {
  const Scratch scratch;
  for (const double bad : {nan, inf}) {
    const Json document = {{"cases", {{{"id", "bar"}, {"speed", {1.0, bad}}}}}};
    const std::string reason =
        message_of<std::invalid_argument>([&] { write_json(scratch / "s.json", document); });
    EXPECT_NE(reason.find("/cases/0/speed/1"), std::string::npos) << reason;
  }
  EXPECT_EQ(scratch.entries(), 0);
}

TEST(Json, RoundTrip) {
  const Scratch scratch;
  const Json document = {{"z", 0.1}, {"a", 1e-300}, {"text", "\xc2\xb5m"}, {"list", {1, 2.5, true, nullptr}}};
  write_json(scratch / "s.json", document);
  EXPECT_EQ(read_json(scratch / "s.json"), document);
  EXPECT_EQ(content_of(scratch / "s.json").substr(0, 12), "{\n  \"z\": 0.1");  // keys in the order given
  EXPECT_NE(to_text({{"bad", "\xff"}}).find("\xef\xbf\xbd"), std::string::npos);
}

TEST(Json, BadFilesAreInputErrors) {
  const Scratch scratch;
  for (const std::string& content : {std::string("{\"a\": }"), std::string(), std::string("\x89PNG\0\xff", 6),
                                     std::string("[1e999]"), std::string(100'000, '['), std::string("NaN")}) {
    put(scratch / "b.json", content);
    const std::string reason = message_of<InputError>([&] { read_json(scratch / "b.json"); });
    EXPECT_NE(reason.find("b.json"), std::string::npos) << reason;
    EXPECT_LT(reason.size(), 1000U);
  }
  EXPECT_THROW(read_json(scratch / "missing.json"), InputError);
}

/// Refused where it was changed; a document without a digest is taken as it is.
TEST(Json, ADigestMustHold) {
  const Scratch scratch;
  const Json document{{"b", 0.1}, {"a", {1, nullptr, "x"}}};
  write_json(scratch / "s.json", sealed(document));
  EXPECT_EQ(read_json(scratch / "s.json"), document);
  EXPECT_EQ(sealed(sealed(document)), sealed(document));
  std::string text = content_of(scratch / "s.json");
  put(scratch / "s.json", Json::parse(text).dump());  // laid out in another way
  EXPECT_EQ(read_json(scratch / "s.json"), document);
  put(scratch / "s.json", text.replace(text.find("0.1"), 3, "0.2"));
  const std::string reason = message_of<InputError>([&] { read_json(scratch / "s.json"); });
  EXPECT_NE(reason.find("s.json"), std::string::npos) << reason;
  EXPECT_NE(reason.find("digest"), std::string::npos) << reason;
  put(scratch / "s.json", R"({"digest": 3})");
  EXPECT_THROW(read_json(scratch / "s.json"), InputError);
}

TEST(Json, ErrorsSayWhereInWordsOfOurs) {
  const std::string reason = message_of<InputError>([] { parse_json("{\"a\": 1,\n \"b\": }", "here"); });
  EXPECT_NE(reason.find("here: not JSON from line 2, column 7"), std::string::npos) << reason;
  EXPECT_EQ(reason.find("exception"), std::string::npos) << reason;
}

TEST(Json, WhatIsDamagedIsNamedWithItsLineInOurWords) {
  for (const char* text : {"", "{", "{\n\"a\": 1,\n", "{\n\"a\": tru", "[1, 2", "\x01", "{\"a\": 1e999}", "{} {}"}) {
    try {
      parse_json(text, "night.json");
      ADD_FAILURE() << text;
    } catch (const InputError& e) {
      EXPECT_EQ(std::string(e.what()).rfind("night.json:", 0), 0u) << e.what();
      EXPECT_EQ(std::string(e.what()).find("json.exception"), std::string::npos) << e.what();
    }
  }
}

}  // namespace
}  // namespace ddem::harness
