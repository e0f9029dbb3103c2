#pragma once
// Numbers for people (tables, labels) and for programs (CSV, coordinates). None of these ever prints nan or
// inf.

#include <limits>
#include <string>
#include <string_view>

namespace ddem::reports {

/// No value: a gap in a line, a dash in a table.
inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// For people: `digits` significant digits, without trailing zeros; "1.2×10⁻⁵" for very large and small ones,
/// with a true minus sign; an en dash if the value is not finite.
std::string number_text(double value, int digits = 6);

/// "10⁻⁵": a power of ten with superscripts.
std::string power_of_ten(int exponent);

/// `value` with a fixed number of decimals and a true minus sign ("−0.50"); never a negative zero.
std::string fixed_text(double value, int decimals);

/// For programs: nine significant digits, as a parser reads it; empty if the value is not finite.
std::string csv_number(double value);

/// An SVG coordinate: at most two decimals, no trailing zeros.
std::string coordinate(double pixels);

}  // namespace ddem::reports
