// Files of outcomes: exact, and never taken for what they are not.

#include "harness/nightly/unit_file.h"

#include <gtest/gtest.h>

#include <limits>

#include "harness/io/digest.h"
#include "harness/io/errors.h"
#include "tests/harness/nightly/toy_units.h"

namespace ddem::harness::nightly {
namespace {

UnitRecord record() {
  return {"toy/a", "identity", {toy_result(3), "", 0.25}};
}

/// FIPS 180-2, appendix B.1, and the empty text.
TEST(Digest, OfTheStandardsExample) {
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(UnitFile, KeepsEveryBit) {
  UnitRecord r = record();
  r.outcome.result["extremes"] = {0.1,
                                  -0.0,
                                  std::numeric_limits<double>::denorm_min(),
                                  std::numeric_limits<double>::max(),
                                  1.0 / 3.0,
                                  0x1.fffffffffffffp-2};
  r.outcome.result["text"] = std::string("a\0b\n\xff", 5);
  r.outcome.result["large"] = std::numeric_limits<std::int64_t>::min();
  const UnitRecord back = parse_unit(to_bytes(r), "here");
  EXPECT_EQ(back.id, r.id);
  EXPECT_EQ(back.identity, r.identity);
  EXPECT_EQ(back.outcome.seconds, r.outcome.seconds);
  EXPECT_EQ(back.outcome.result, r.outcome.result);
  EXPECT_TRUE(std::signbit(back.outcome.result["extremes"][1].get<double>()));
  EXPECT_EQ(to_bytes(back), to_bytes(r));
}

TEST(UnitFile, EveryBrokenByteIsFound) {
  const std::string good = to_bytes(record());
  for (std::size_t k = 0; k < good.size(); ++k) {
    std::string bad = good;
    bad[k] = static_cast<char>(bad[k] ^ 0x20);
    EXPECT_THROW(parse_unit(bad, "here"), InputError) << k;
  }
}

TEST(UnitFile, EveryCutIsFound) {
  const std::string good = to_bytes(record());
  for (std::size_t k = 0; k < good.size(); ++k)
    EXPECT_THROW(parse_unit(good.substr(0, k), "here"), InputError) << k;
  EXPECT_THROW(parse_unit(good + '\0', "here"), InputError);
}

std::string with_checksum(const std::string& content) {
  return "ddem unit 1 " + sha256(content) + "\n" + content;
}

/// A checksum that holds says nothing of what is inside.
TEST(UnitFile, RubbishWithAGoodChecksum) {
  std::string deep(200000, '\x81');  // CBOR: arrays of one element, each in the one before
  for (const std::string& content :
       {std::string(), std::string("\xff"), std::string("\x01"), std::string("\xa1\x61\x61\x01"), deep,
        std::string("\x9b\x7f\xff\xff\xff\xff\xff\xff\xff"),
        std::string("\x5b\x7f\xff\xff\xff\xff\xff\xff\xff")}) {
    EXPECT_THROW(parse_unit(with_checksum(content), "here"), InputError);
  }
  UnitRecord infinite = record();
  infinite.outcome.result["series"][3] = HUGE_VAL;
  EXPECT_NE(message_of<InputError>([&] { parse_unit(to_bytes(infinite), "here"); }).find("/result/series/3"), std::string::npos);
  UnitRecord neither = record();
  neither.outcome.result = nullptr;
  EXPECT_THROW(parse_unit(to_bytes(neither), "here"), InputError);
}

TEST(UnitFile, OfOtherInputsOrAnotherUnit) {
  const Scratch scratch;
  write_unit(scratch / "", record());
  EXPECT_EQ(read_unit(scratch / "", "toy/a", "identity").outcome.result, toy_result(3));
  EXPECT_THROW(read_unit(scratch / "", "toy/a", "another"), InputError);
  EXPECT_THROW(read_unit(scratch / "", "toy/b", "identity"), InputError);
  std::filesystem::copy_file(unit_path(scratch / "", "toy/a"), unit_path(scratch / "", "toy/b"));
  EXPECT_THROW(read_unit(scratch / "", "toy/b", "identity"), InputError);
}

TEST(UnitFile, TimesAreNoContent) {
  UnitRecord a = record(), b = record();
  b.outcome.result["seconds"] = 7.0;
  b.outcome.result["inside"] = a.outcome.result["inside"] =
      nlohmann::json::array({{{"solve_seconds", 1.0}, {"x", 2.0}}});
  b.outcome.result["inside"][0]["solve_seconds"] = 3.0;
  b.outcome.seconds = 9.0;
  EXPECT_EQ(content_digest(a), content_digest(b));
  b.outcome.result["inside"][0]["x"] = 2.0000000000000004;
  EXPECT_NE(content_digest(a), content_digest(b));
}

TEST(Identity, IsOfInputsNameAndProgram) {
  const Unit unit{"a", "k_n = 1", 1, {}};
  const std::string identity = identity_of(unit, "p");
  EXPECT_EQ(identity_of({"a", "k_n = 1", 5, {}}, "p"), identity);
  EXPECT_NE(identity_of({"b", "k_n = 1", 1, {}}, "p"), identity);
  EXPECT_NE(identity_of({"a", "k_n = 2", 1, {}}, "p"), identity);
  EXPECT_NE(identity_of(unit, "q"), identity);
}

/// What a solver makes of a result with NaN or an infinity is no result, wherever it stands.
TEST(RunUnit, NumbersThatAreNotFiniteAreNoResult) {
  for (const double wrong :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity()}) {
    for (const char* place : {"/speed", "/series/17", "/deep"}) {
      const Unit unit{"a", "", 1, [&] {
                        nlohmann::json j = toy_result(1);
                        j[nlohmann::json::json_pointer(place)] = wrong;
                        return j;
                      }};
      const Outcome o = run_unit(unit);
      EXPECT_NE(o.failure.find(place), std::string::npos) << o.failure;
      EXPECT_TRUE(o.result.is_null());
    }
  }
  EXPECT_EQ(run_unit({"a", "", 1, [] { return toy_result(1); }}).failure, "");
}

TEST(RunUnit, ExceptionsAreItsFailure) {
  EXPECT_EQ(run_unit({"a", "", 1, []() -> nlohmann::json { throw std::runtime_error("broke"); }}).failure,
            "broke");
  EXPECT_NE(run_unit({"a", "", 1, []() -> nlohmann::json { throw 3; }}).failure, "");
  EXPECT_NE(run_unit({"a", "", 1, [] { return nlohmann::json(); }}).failure, "");
}

}  // namespace
}  // namespace ddem::harness::nightly
