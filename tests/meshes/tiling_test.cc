#include "meshes/packings/tiling.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace ddem::packings {
namespace {

TEST(Tiling, JamsSmallSamplesAsAWhole) {
  for (const int discs : {2, 682, 10007, 20000}) {
    const Tiling t = tiling_of(discs, 16.5e-3, 2e-3);
    EXPECT_EQ(t.nx, 1);
    EXPECT_EQ(t.ny, 1);
    EXPECT_EQ(t.discs, discs);
  }
}

TEST(Tiling, GivesTheNumberOfDiscsExactlyFromCellsThatAreNotSlender) {
  for (const std::int64_t discs : {24000, 43648, 100000, 174592, 1000000, 100000000}) {
    const Tiling t = tiling_of(discs, 16.5e-3, 2e-3);
    EXPECT_EQ(static_cast<std::int64_t>(t.nx) * t.ny * t.discs, discs);
    EXPECT_TRUE(t.discs >= 1000 && t.discs <= 4000);
    const double ratio = (16.5e-3 / t.nx) / (2e-3 / t.ny);
    EXPECT_TRUE(ratio <= 4.0 && ratio >= 0.25) << ratio;
  }
}

TEST(Tiling, NamesTheNearestNumberThatCanBeHad) {
  try {
    tiling_of(100003, 16.5e-3, 2e-3);  // a prime number
    FAIL();
  } catch (const std::invalid_argument& e) {
    const std::string message = e.what();
    const auto after = message.find("do not make: ");
    ASSERT_NE(after, std::string::npos) << message;
    const std::int64_t other = std::stoll(message.substr(after + 13));
    EXPECT_NO_THROW(tiling_of(other, 16.5e-3, 2e-3));
    EXPECT_NEAR(static_cast<double>(other), 100003.0, 2000.0);
  }
  EXPECT_THROW(tiling_of(1000000000000, 1.0, 1.0), std::invalid_argument);
}

}  // namespace
}  // namespace ddem::packings
