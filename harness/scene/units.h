#pragma once
// Quantities with units, as users write them in a scene: "16.5 mm", "10 GPa", "2e-5 s".

#include <optional>
#include <string>
#include <string_view>

namespace ddem::harness {

enum class Dimension { none, length, time, stress, density, stiffness, velocity };

/// "length", "time", ...; "number" for Dimension::none.
std::string_view dimension_name(Dimension dimension);
/// The SI unit in which plain numbers are understood: "m", "s", "Pa", "kg/m3", "N/m"; "" for Dimension::none.
std::string_view si_unit(Dimension dimension);
/// Examples of how a quantity of this dimension may be written.
std::string_view quantity_examples(Dimension dimension);

struct Quantity {
  std::optional<double> si;
  std::string problem;  ///< why there is no value
};

/// Reads a number followed by a unit. Every accepted unit is a power of ten of the SI unit, so the value is
/// the correctly rounded one: "16.5 mm" equals the literal 16.5e-3 to the last bit.
Quantity parse_quantity(std::string_view text, Dimension dimension);

}  // namespace ddem::harness
