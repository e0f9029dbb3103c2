// Escapes, UTF-8, numbers, markup.
#include "reports/text.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "reports/markup.h"
#include "reports/number.h"

namespace ddem::reports {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
const std::string kBad = "\xEF\xBF\xBD";

TEST(Text, EscapesMarkup) {
  EXPECT_EQ(escape("a<b>&\"'c"), "a&lt;b&gt;&amp;&quot;&#39;c");
}

TEST(Text, KeepsValidUtf8) {
  const std::string text = "Poisson’s ν, 波, 🌊, ü\t\n";
  EXPECT_EQ(clean_utf8(text), text);
}

TEST(Text, ReplacesInvalidUtf8AndWhatXmlForbids) {
  EXPECT_EQ(clean_utf8("a\xFF"), "a" + kBad);
  EXPECT_EQ(clean_utf8("\xC3"), kBad);                                   // truncated
  EXPECT_EQ(clean_utf8("\xC0\xAF"), kBad + kBad);                        // overlong '/'
  EXPECT_EQ(clean_utf8("\xED\xA0\x80"), kBad + kBad + kBad);             // surrogate
  EXPECT_EQ(clean_utf8("\xF4\x90\x80\x80"), kBad + kBad + kBad + kBad);  // beyond U+10FFFF
  EXPECT_EQ(clean_utf8(std::string("a\0b", 3)), "a" + kBad + "b");
  EXPECT_EQ(clean_utf8("\x1B[31m"), kBad + "[31m");
  EXPECT_EQ(clean_utf8("\xEF\xBF\xBF"), kBad);  // U+FFFF
  EXPECT_EQ(clean_utf8("a\r\nb\rc"), "a\nb\nc");
}

TEST(Text, SlugIsSafeAsIdAndFileName) {
  EXPECT_EQ(slug("../Nu & <k_t>"), "nu-k-t");
  EXPECT_EQ(slug("ν"), "unnamed");
}

TEST(Text, PercentEncodesAllButPlainAscii) {
  EXPECT_EQ(percent_encode("1,\"é\"\n#%"), "1,%22%C3%A9%22%0A%23%25");
}

TEST(Text, WrapsAtSpaces) {
  const std::vector<std::string> lines = wrap_text("one two three", text_width("one two", 12) + 1, 12);
  EXPECT_EQ(lines, (std::vector<std::string>{"one two", "three"}));
  EXPECT_EQ(wrap_text("unbreakable", 1, 12).size(), 1u);
  EXPECT_TRUE(wrap_text(" \n ", 100, 12).empty());
}

TEST(Number, ForPeople) {
  EXPECT_EQ(number_text(0.3333333333), "0.333333");
  EXPECT_EQ(number_text(-1.2e-7), "−1.2×10⁻⁷");
  EXPECT_EQ(number_text(2.5e12), "2.5×10¹²");
  EXPECT_EQ(number_text(-0.0), "0");
  EXPECT_EQ(number_text(kNan), "–");
  EXPECT_EQ(number_text(std::numeric_limits<double>::infinity()), "–");
  EXPECT_EQ(fixed_text(-0.0004, 2), "0.00");
  EXPECT_EQ(fixed_text(-1.25, 1), "−1.2");  // to even
}

TEST(Number, ForPrograms) {
  EXPECT_EQ(csv_number(1.0 / 3.0), "0.333333333");
  EXPECT_EQ(csv_number(-0.0), "0");
  EXPECT_EQ(csv_number(kNan), "");
  EXPECT_EQ(coordinate(-0.001), "0");
  EXPECT_EQ(coordinate(12.50), "12.5");
  EXPECT_EQ(coordinate(kNan), "0");
}

TEST(Markup, BalancesAndEscapes) {
  Markup out;
  out.open("a", {{"href", "x\"y"}, {"n", 1.5}}).text("1 < 2").close();
  EXPECT_EQ(out.take(), "<a href=\"x&quot;y\" n=\"1.5\">1 &lt; 2</a>");
  EXPECT_THROW(out.close(), std::logic_error);
  out.open("p");
  EXPECT_THROW(out.take(), std::logic_error);
}

}  // namespace
}  // namespace ddem::reports
