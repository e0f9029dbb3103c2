#pragma once
// Quantities with units, as users write them in a scene: "16.5 mm", "10 GPa", "2e-5 s".

#include <optional>
#include <string>
#include <string_view>

namespace ddem::harness {

enum class Dimension { none, length, time, stress, density, stiffness, velocity, frequency };

/// "length", "time", ...; "number" for Dimension::none.
std::string_view dimension_name(Dimension dimension);
/// The SI unit in which plain numbers are understood: "m", "s", "Pa", "kg/m3", "N/m", "Hz"; "" for Dimension::none.
std::string_view si_unit(Dimension dimension);
/// Examples of how a quantity of this dimension may be written.
std::string_view quantity_examples(Dimension dimension);

/// What numbers other than 0 of a dimension may be in size, in SI units: whatever is simulated lies far inside, and no
/// product or power of such numbers that the program forms overflows, or loses digits by underflow.
struct Magnitude {
  double least, most;
};
Magnitude magnitude_of(Dimension dimension);
/// "too large: a length is at most 1e+12 m in size"; empty where the value may be, or is no finite number, which has
/// no size.
std::string magnitude_problem(double si, Dimension dimension);

struct Quantity {
  std::optional<double> si;
  std::string problem;  ///< why there is no value
};

/// Reads a number followed by a unit. Every accepted unit is a power of ten of the SI unit, so the value is
/// the correctly rounded one: "16.5 mm" equals the literal 16.5e-3 to the last bit.
Quantity parse_quantity(std::string_view text, Dimension dimension);

/// A value for people, with the prefix that puts it between 1 and 1000 where the unit has such a one: "112.733 um",
/// "13.3 GPa", "2728 m/s". Lengths and times have prefixes below, Pa, N, N/m and Hz above; others none.
std::string format_quantity(double si, std::string_view unit, int digits = 6);

}  // namespace ddem::harness
