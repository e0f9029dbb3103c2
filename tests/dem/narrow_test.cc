// Conversions of what users write never wrap around.

#include "dem/core/narrow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

namespace ddem {
namespace {

template <class To, class From>
bool refused(From value) {
  try {
    EXPECT_EQ(static_cast<long double>(narrow<To>(value, "n")), std::trunc(static_cast<long double>(value)));
    return false;
  } catch (const std::invalid_argument& e) {
    EXPECT_EQ(std::string(e.what()).rfind("n: ", 0), 0u);
    return true;
  }
}

TEST(Narrow, IntegersAtTheirEnds) {
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max(), least = std::numeric_limits<std::int32_t>::min();
  EXPECT_FALSE((refused<std::int32_t>(most)));
  EXPECT_TRUE((refused<std::int32_t>(most + 1)));
  EXPECT_FALSE((refused<std::int32_t>(least)));
  EXPECT_TRUE((refused<std::int32_t>(least - 1)));
  EXPECT_TRUE((refused<std::uint32_t>(-1)));
  EXPECT_TRUE((refused<std::int64_t>(std::numeric_limits<std::uint64_t>::max())));
  EXPECT_FALSE((refused<std::uint8_t>(255)));
  EXPECT_TRUE((refused<std::uint8_t>(256)));
}

TEST(Narrow, NumbersAtTheEndsOfIntegers) {
  EXPECT_FALSE((refused<std::int32_t>(2147483647.0)));
  EXPECT_TRUE((refused<std::int32_t>(2147483648.0)));
  EXPECT_FALSE((refused<std::int32_t>(-2147483648.0)));
  EXPECT_TRUE((refused<std::int32_t>(-2147483649.0)));
  EXPECT_TRUE((refused<std::int64_t>(0x1p63)));
  EXPECT_FALSE((refused<std::int64_t>(0x1p62)));
  EXPECT_TRUE((refused<std::uint64_t>(0x1p64)));
  EXPECT_TRUE((refused<std::uint32_t>(-1.0)));
  EXPECT_FALSE((refused<std::int32_t>(-3.9)));
  for (const double none : {std::nan(""), HUGE_VAL, -HUGE_VAL}) EXPECT_TRUE((refused<std::int64_t>(none)));
}

}  // namespace
}  // namespace ddem
