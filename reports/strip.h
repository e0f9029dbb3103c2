#pragma once
// Draws the assembly: discs to equal aspect ratio, colour bar, probes.

#include "reports/figure.h"
#include "reports/geometry.h"
#include "reports/markup.h"

namespace ddem::reports {

/// At most this many discs are drawn; of more, every n-th, larger (`discs_drawn` says how many).
constexpr std::size_t kMaxDiscs = 20000;
std::size_t discs_drawn(const Strip& strip);

/// Whether the colours are those of values of both signs.
inline bool is_signed(Limits limits) { return limits.lower == -limits.upper; }

/// Height that the strip takes when it is `width` pixels wide.
double strip_height(const Strip& strip, double width);

void draw_strip(Markup& out, const Strip& strip, Point corner, double width);

}  // namespace ddem::reports
