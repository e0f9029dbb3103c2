#include "harness/scene/units.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <span>

namespace ddem::harness {
namespace {

struct DimensionRow {
  std::string_view name, si_unit, examples;
  Magnitude magnitude;
};

// The magnitudes: the inertia rho pi r^4 h/2 of a disc is from 1e-96 to 1e78, a squared frequency k/m from 1e-78 to 1e96.
constexpr std::array<DimensionRow, 8> dimension_rows{{
    {"number", "", "0.25", {1e-12, 1e6}},
    {"length", "m", "\"16.5 mm\", \"1 um\" or 0.0165 (metres)", {1e-18, 1e12}},
    {"time", "s", "\"3 us\", \"2e-5 s\" or 2e-5 (seconds)", {1e-30, 1e15}},
    {"stress", "Pa", "\"10 GPa\", \"200 MPa\" or 1e10 (pascals)", {1e-6, 1e21}},
    {"density", "kg/m3", "\"2000 kg/m3\", \"2 g/cm3\" or 2000 (kg/m3)", {1e-6, 1e18}},
    {"stiffness", "N/m", "\"10 GN/m\", \"1e10 N/m\" or 1e10 (N/m)", {1e-9, 1e24}},
    {"velocity", "m/s", "\"3500 m/s\", \"3.5 km/s\" or 3500 (m/s)", {1e-9, 1e12}},
    {"frequency", "Hz", "\"50 kHz\", \"2 MHz\" or 5e4 (hertz)", {1e-9, 1e18}},
}};

const DimensionRow& row_of(Dimension dimension) {
  return dimension_rows[static_cast<std::size_t>(dimension)];
}

// The prefixes that are in use for a dimension. Others would sooner be slips than meant: mPa for MPa.
struct BaseUnit {
  Dimension dimension;
  std::string_view name;
  int power_of_ten;  // to SI
  std::string_view prefixes;
};

constexpr std::array base_units{
    BaseUnit{Dimension::length, "m", 0, "pnumck"},   BaseUnit{Dimension::time, "s", 0, "pnum"},
    BaseUnit{Dimension::stress, "Pa", 0, "kMGT"},    BaseUnit{Dimension::stress, "N/m2", 0, "kMG"},
    BaseUnit{Dimension::stress, "N/mm2", 6, "k"},    BaseUnit{Dimension::density, "kg/m3", 0, ""},
    BaseUnit{Dimension::density, "g/cm3", 3, ""},    BaseUnit{Dimension::density, "kg/dm3", 3, ""},
    BaseUnit{Dimension::density, "t/m3", 3, ""},     BaseUnit{Dimension::stiffness, "N/m", 0, "kMG"},
    BaseUnit{Dimension::stiffness, "N/mm", 3, "kM"},
    BaseUnit{Dimension::velocity, "m/s", 0, "k"}, BaseUnit{Dimension::frequency, "Hz", 0, "kMG"},
};

struct Prefix {
  char name;
  int power_of_ten;
};
constexpr std::array prefixes{Prefix{'p', -12}, Prefix{'n', -9}, Prefix{'u', -6},
                              Prefix{'m', -3},  Prefix{'c', -2}, Prefix{'k', 3},
                              Prefix{'M', 6},   Prefix{'G', 9},  Prefix{'T', 12}};

// One spelling of each unit: the two Unicode letters mu become u, "m^3" and "m³" become "m3".
std::string plain_spelling(std::string_view unit) {
  struct Spelling {
    std::string_view written, plain;
  };
  constexpr std::array spellings{Spelling{"\u00B5", "u"}, Spelling{"\u03BC", "u"}, Spelling{"\u00B2", "2"},
                                 Spelling{"\u00B3", "3"}, Spelling{"^", ""}};
  std::string plain;
  while (!unit.empty()) {
    std::string_view next = unit.substr(0, 1);
    std::string_view replacement = next;
    for (const Spelling& spelling : spellings) {
      if (!unit.starts_with(spelling.written)) continue;
      next = spelling.written;
      replacement = spelling.plain;
    }
    plain += replacement;
    unit.remove_prefix(next.size());
  }
  return plain;
}

std::optional<int> power_of_ten(std::string_view unit, const BaseUnit& base) {
  if (unit == base.name) return base.power_of_ten;
  if (unit.size() != base.name.size() + 1 || unit.substr(1) != base.name) return std::nullopt;
  if (base.prefixes.find(unit.front()) == std::string_view::npos) return std::nullopt;
  for (const Prefix& prefix : prefixes) {
    if (prefix.name == unit.front()) return base.power_of_ten + prefix.power_of_ten;
  }
  return std::nullopt;
}

std::string_view trim(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// A decimal number at the start of a text, split so that its exponent can be shifted without rounding.
struct Decimal {
  std::string_view mantissa;  // "" when there is no number
  int exponent = 0;
  std::string_view rest;
};

Decimal split_decimal(std::string_view text) {
  std::size_t end = 0;
  if (end < text.size() && (text[end] == '+' || text[end] == '-')) ++end;
  std::size_t digits = 0;
  for (bool point = false; end < text.size(); ++end) {
    if (is_digit(text[end])) {
      ++digits;
    } else if (text[end] == '.' && !point) {
      point = true;
    } else {
      break;
    }
  }
  if (digits == 0) return {};
  Decimal decimal{text.substr(0, end), 0, text.substr(end)};
  if (decimal.mantissa.front() == '+') decimal.mantissa.remove_prefix(1);
  if (decimal.rest.empty() || (decimal.rest[0] != 'e' && decimal.rest[0] != 'E')) return decimal;
  std::string_view exponent = decimal.rest.substr(1);
  if (exponent.starts_with('+') && exponent.size() > 1 && is_digit(exponent[1])) exponent.remove_prefix(1);
  int value = 0;
  const auto [stop, error] = std::from_chars(exponent.data(), exponent.data() + exponent.size(), value);
  if (error == std::errc::invalid_argument) return decimal;  // the e begins the unit
  constexpr int beyond_any_double = 1'000'000;
  const bool tame = error == std::errc{} && value > -beyond_any_double && value < beyond_any_double;
  decimal.exponent = tame ? value : (exponent.front() == '-' ? -beyond_any_double : beyond_any_double);
  decimal.rest = exponent.substr(static_cast<std::size_t>(stop - exponent.data()));
  return decimal;
}

std::string unit_problem(std::string_view written, const std::string& unit, Dimension dimension) {
  for (const BaseUnit& base : base_units) {
    if (power_of_ten(unit, base)) {
      return fmt::format("\"{}\" is a unit of {}, but a {} is expected", written,
                         dimension_name(base.dimension), dimension_name(dimension));
    }
  }
  return fmt::format("\"{}\" is not a known unit of {}", written, dimension_name(dimension));
}

}  // namespace

std::string_view dimension_name(Dimension dimension) {
  return row_of(dimension).name;
}
std::string_view si_unit(Dimension dimension) {
  return row_of(dimension).si_unit;
}
std::string_view quantity_examples(Dimension dimension) {
  return row_of(dimension).examples;
}

Magnitude magnitude_of(Dimension dimension) {
  return row_of(dimension).magnitude;
}

std::string magnitude_problem(double si, Dimension dimension) {
  const auto& [name, unit, examples, magnitude] = row_of(dimension);
  const double size = std::abs(si);
  if (size == 0.0 || !std::isfinite(size) || (size >= magnitude.least && size <= magnitude.most)) return "";
  const bool small = size < magnitude.least;
  return fmt::format("too {}: a {} other than 0 is at {} {:g}{}{} in size", small ? "small" : "large", name, small ? "least" : "most",
                     small ? magnitude.least : magnitude.most, unit.empty() ? "" : " ", unit);
}

Quantity parse_quantity(std::string_view text, Dimension dimension) {
  const Decimal decimal = split_decimal(trim(text));
  if (decimal.mantissa.empty()) {
    return {std::nullopt,
            fmt::format("a {} is expected, beginning with a number", dimension_name(dimension))};
  }
  const std::string_view written = trim(decimal.rest);
  if (written.empty()) return {std::nullopt, "a number in quotes needs a unit"};
  const std::string unit = plain_spelling(written);
  for (const BaseUnit& base : base_units) {
    if (base.dimension != dimension) continue;
    const std::optional<int> shift = power_of_ten(unit, base);
    if (!shift) continue;
    const std::string shifted = fmt::format("{}e{}", decimal.mantissa, decimal.exponent + *shift);
    double si = 0.0;
    const auto [stop, error] = std::from_chars(shifted.data(), shifted.data() + shifted.size(), si);
    if (error != std::errc{} || !std::isfinite(si)) {
      return {std::nullopt, "too large or too small to be represented"};
    }
    return {si, {}};
  }
  return {std::nullopt, unit_problem(written, unit, dimension)};
}

std::string format_quantity(double si, std::string_view unit, int digits) {
  const std::string_view names = unit == "m" || unit == "s" ? "pnum" : unit == "Pa" || unit == "N" || unit == "N/m" || unit == "Hz" ? "kMGT" : "";
  // What will be printed decides: 999.9999 um is 1 mm.
  const double magnitude = std::abs(std::stod(fmt::format("{:.{}e}", si, digits - 1)));
  int power = 0;
  std::string prefix;
  for (const Prefix& p : prefixes) {
    if (names.find(p.name) == std::string_view::npos || !(magnitude > 0.0)) continue;
    const double unit_of_prefix = std::pow(10.0, p.power_of_ten);
    const bool below = p.power_of_ten < 0 && prefix.empty() && magnitude < 1000.0 * unit_of_prefix;
    const bool above = p.power_of_ten > 0 && magnitude >= unit_of_prefix;
    if (!below && !above) continue;
    power = p.power_of_ten;
    prefix = p.name;
  }
  return fmt::format("{:.{}g} {}{}", power < 0 ? si * std::pow(10.0, -power) : si / std::pow(10.0, power), digits, prefix, unit);
}

}  // namespace ddem::harness
