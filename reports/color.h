#pragma once
// Colours: Okabe and Ito's palette for series, viridis for values.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "reports/figure.h"

namespace ddem::reports {

using Rgb = std::array<std::uint8_t, 3>;

/// "#rrggbb" of a palette colour; Color::automatic is the dark grey of text.
std::string_view color_hex(Color color);

/// The colour of the index-th automatic series; yellow, which is faint on white, is never chosen.
Color automatic_color(std::size_t index);

/// Viridis (van der Walt and Smith, 2015) at t in [0, 1]; outside it is clamped.
Rgb viridis(double t);

/// Blue at -1 through white at 0 to red at 1 (the ends of ColorBrewer's RdBu); outside it is clamped.
Rgb diverging(double t);

std::string hex(Rgb color);

}  // namespace ddem::reports
