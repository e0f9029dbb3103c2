#include "reports/number.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

namespace ddem::reports {
namespace {

constexpr std::string_view kMinus = "\u2212";

std::string with_true_minus(std::string text) {
  if (!text.empty() && text.front() == '-') text.replace(0, 1, kMinus);
  return text;
}

}  // namespace

std::string power_of_ten(int exponent) {
  static constexpr std::string_view superscripts[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out = "10";
  for (const char c : std::to_string(exponent))
    out += c == '-' ? std::string_view("⁻") : superscripts[c - '0'];
  return out;
}

std::string number_text(double value, int digits) {
  if (!std::isfinite(value)) return "–";
  if (value == 0.0) return "0";
  std::string text = fmt::format("{:.{}g}", value, digits);
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return with_true_minus(text);
  const int exponent = std::atoi(text.c_str() + e + 1);
  return with_true_minus(text.substr(0, e)) + "×" + power_of_ten(exponent);
}

std::string fixed_text(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  const bool zero = text.find_first_of("123456789") == std::string::npos;
  if (zero && text.front() == '-') text.erase(0, 1);
  return with_true_minus(text);
}

std::string csv_number(double value) {
  return std::isfinite(value) ? fmt::format("{:.9g}", value + 0.0) : std::string();
}

std::string coordinate(double pixels) {
  std::string text = fmt::format("{:.2f}", std::isfinite(pixels) ? pixels : 0.0);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

}  // namespace ddem::reports
